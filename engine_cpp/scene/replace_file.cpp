// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/replace_file.h"

#include "scene/error.h"

#include <fcntl.h>
#include <unistd.h>
#include <atomic>
#include <cerrno>
#include <cstring>

namespace cardioid::scene {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
    throw SceneError("cannot write '" + path.string() + "': " + why);
}

/// Beside the target, so that the rename stays within one file system. Unique in this machine's processes and threads.
std::filesystem::path temporary_name(const std::filesystem::path& path) {
    static std::atomic<unsigned> count{0};
    const std::string mark = ".part-" + std::to_string(::getpid()) + '-' + std::to_string(count++);
    return path.parent_path() / (path.stem().string() + mark + path.extension().string());
}

/// Removes the file unless it was renamed.
class Temporary {
public:
    explicit Temporary(const std::filesystem::path& target) : target_(target), path_(temporary_name(target)) {}
    ~Temporary() {
        std::error_code ignored;
        if (!renamed_) std::filesystem::remove(path_, ignored);
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    const std::filesystem::path& path() const { return path_; }
    void rename() {
        std::error_code error;
        std::filesystem::rename(path_, target_, error);
        if (error) fail(target_, error.message());
        renamed_ = true;
    }

private:
    const std::filesystem::path& target_;
    std::filesystem::path path_;
    bool renamed_ = false;
};

class Descriptor {
public:
    explicit Descriptor(int value) : value_(value) {}
    ~Descriptor() {
        if (value_ >= 0) ::close(value_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const { return value_; }
    /// Network file systems report a full disk only here.
    bool close() { return ::close(std::exchange(value_, -1)) == 0; }

private:
    int value_;
};

}  // namespace

void FileWriter::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t done = ::write(descriptor_, bytes.data(), bytes.size());
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) fail(path_, std::strerror(errno));
        if (done == 0) fail(path_, "nothing more could be written");
        bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
}

void replace_file(const std::filesystem::path& path, const std::function<void(FileWriter&)>& write) {
    Temporary temporary(path);
    Descriptor file(::open(temporary.path().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (file.get() < 0) fail(path, std::strerror(errno));
    FileWriter writer(path, file.get());
    write(writer);
    // Without this a crash of the machine could leave a renamed but empty file.
    if (::fsync(file.get()) != 0 && errno != EINVAL && errno != ENOTSUP) fail(path, std::strerror(errno));
    if (!file.close()) fail(path, std::strerror(errno));
    temporary.rename();
}

void replace_file_by_name(const std::filesystem::path& path, const std::function<void(const std::string&)>& write) {
    Temporary temporary(path);
    write(temporary.path().string());
    temporary.rename();
}

}  // namespace cardioid::scene
