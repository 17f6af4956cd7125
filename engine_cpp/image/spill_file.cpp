// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/spill_file.h"

#include <fcntl.h>
#include <unistd.h>
#include <cstdlib>

namespace cardioid::image {

SpillFile::~SpillFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

std::int64_t SpillFile::allocate(std::int64_t bytes) {
    std::call_once(opened_, [this] {
        // /tmp is memory on many systems, which would defeat the purpose.
        for (const char* folder : {static_cast<const char*>(std::getenv("TMPDIR")), "/var/tmp", "/tmp"}) {
            if (folder && descriptor_ < 0) descriptor_ = ::open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
        }
    });
    return end_.fetch_add(bytes);
}

bool SpillFile::write(std::int64_t at, std::span<const std::byte> bytes) {
    while (descriptor_ >= 0 && !bytes.empty()) {
        const ssize_t done = ::pwrite(descriptor_, bytes.data(), bytes.size(), at);
        if (done <= 0) return false;
        at += done;
        bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
    return bytes.empty();
}

bool SpillFile::read(std::int64_t at, std::span<std::byte> bytes) const {
    while (descriptor_ >= 0 && !bytes.empty()) {
        const ssize_t done = ::pread(descriptor_, bytes.data(), bytes.size(), at);
        if (done <= 0) return false;
        at += done;
        bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
    return bytes.empty();
}

}  // namespace cardioid::image
