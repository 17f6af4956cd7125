// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/memory_file.h"

#include "scene/error.h"

#include <sys/mman.h>
#include <unistd.h>

namespace cardioid::image {

MemoryFile::MemoryFile(const std::vector<std::uint8_t>& bytes)
    : descriptor_(::memfd_create("cardioid-image", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw scene::SceneError("cannot be unpacked: the system gives no memory file");
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t written = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
        if (written <= 0) {
            ::close(descriptor_);
            throw scene::SceneError("cannot be unpacked: not enough memory");
        }
        done += static_cast<std::size_t>(written);
    }
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

std::string MemoryFile::path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

}  // namespace cardioid::image
