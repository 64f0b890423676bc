// Files that appear whole or not at all.
#pragma once

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "octafield/error.hpp"

namespace octafield {

// A new file beside the target, removed unless it has been moved onto it. A target that is a symbolic link is followed;
// one that exists and is no regular file (a folder, a device) is refused. Throws IoError, kind "unwritable".
class TemporaryFile {
public:
    explicit TemporaryFile(const std::filesystem::path& target) : target_(target) {
        std::error_code error;
        for (int links = 0; links < 40 && std::filesystem::is_symlink(target_, error); ++links)  // 40: a loop of links
            target_ = target_.parent_path() / std::filesystem::read_symlink(target_, error);
        if (std::filesystem::exists(target_, error) && !std::filesystem::is_regular_file(target_, error))
            fail("it exists and is no regular file");
        static std::atomic<unsigned> counter{0};
        path_ = target_;
        path_ += ".part" + std::to_string(getpid()) + "-" + std::to_string(counter++);
        errno = 0;
        if (!std::ofstream(path_)) fail(errno ? std::strerror(errno) : "the file could not be opened");
    }
    ~TemporaryFile() {
        std::error_code ignored;
        if (!path_.empty()) std::filesystem::remove(path_, ignored);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    const std::filesystem::path& path() const { return path_; }
    void move_to_target() {
        std::error_code error;
        std::filesystem::rename(path_, target_, error);
        if (error) fail(error.message());
    }
    [[noreturn]] void fail(const std::string& reason) const {
        throw IoError("cannot write " + target_.string() + ": " + reason +
                          "; check that its folder exists, is writable and has space",
                      "unwritable");
    }

private:
    std::filesystem::path target_, path_;
};

}  // namespace octafield
