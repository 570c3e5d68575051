// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Output files appear complete or not at all: each is written to a temporary file in the target's
// folder, synchronized to disk, and renamed.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <fstream>
#include <ostream>
#include <stdexcept>
#include <system_error>

#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum {
namespace {

namespace fs = std::filesystem;

std::string error_text(int error_number) { return std::generic_category().message(error_number); }

[[noreturn]] void fail(const fs::path& path, int error_number) {
  throw std::runtime_error(
      fmt::format("{}: cannot be written: {}", path.string(),
                  error_number ? error_text(error_number) : std::string("input/output error")));
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// A temporary file in the folder of the target, so that the rename stays on one file system. The
/// destructor removes it unless it has replaced the target.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) : target_(target) {
    static std::atomic<unsigned> counter{0};
    int file = -1;
    do {
      // Short and independent of the target's name, which may have the maximum length.
      path_ = folder_of(target) / fmt::format(".transillum-{}-{}.tmp", ::getpid(), counter++);
      file = ::open(path_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    } while (file < 0 && errno == EEXIST);
    if (file < 0) {
      fail(target, errno);
    }
    ::close(file);
  }
  ~TemporaryFile() {
    std::error_code ignored;
    if (!path_.empty()) {
      fs::remove(path_, ignored);
    }
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const fs::path& path() const { return path_; }

  void replace_target() {
    synchronize();
    std::error_code ignored;
    const fs::file_status old = fs::status(target_, ignored);
    if (fs::exists(old)) {
      fs::permissions(path_, old.permissions(), ignored);
    }
    std::error_code error;
    fs::rename(path_, target_, error);
    if (error) {
      fail(target_, error.value());
    }
    path_.clear();
  }

 private:
  /// Without this, a crash of the machine could leave the target empty.
  void synchronize() const {
    const int file = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) {
      fail(target_, errno);
    }
    const int error = ::fsync(file) == 0 ? 0 : errno;
    ::close(file);
    // Some file systems do not support it; the result is kept all the same.
    if (error != 0 && error != EINVAL && error != ENOTSUP) {
      fail(target_, error);
    }
  }

  fs::path target_, path_;
};

void fill(const fs::path& file, const fs::path& target,
          const std::function<void(std::ostream&)>& write) {
  errno = 0;
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  if (out) {
    write(out);
  }
  out.flush();
  const int error = errno;
  if (!out) {
    fail(target, error);
  }
  out.close();
  if (!out) {
    fail(target, errno);
  }
}

/// The end of a chain of symbolic links, so that the link stays and its target is replaced.
fs::path resolve_links(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) {
    return path;
  }
  fs::path resolved = fs::weakly_canonical(path, error);
  return error ? path : resolved;
}

}  // namespace

void write_file_whole(const std::filesystem::path& path,
                      const std::function<void(std::ostream&)>& write) {
  std::error_code ignored;
  const fs::path target = resolve_links(path);
  const fs::file_status status = fs::status(target, ignored);
  if (fs::is_directory(status)) {
    fail(path, EISDIR);
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    fill(target, path, write);  // a device cannot be replaced by renaming
    return;
  }
  TemporaryFile temporary(target);
  fill(temporary.path(), path, write);
  temporary.replace_target();
}

void check_writable(const std::filesystem::path& path) {
  std::error_code ignored;
  const fs::path target = resolve_links(path);
  if (path.empty()) {
    throw InputError("output file: the name is empty");
  }
  if (fs::is_directory(target, ignored)) {
    throw InputError(fmt::format("{}: cannot be written: it is a folder", path.string()));
  }
  // Opening one would block until a reader opens it, and no signal ends the wait.
  if (fs::is_fifo(target, ignored)) {
    throw InputError(fmt::format("{}: cannot be written: it is a pipe", path.string()));
  }
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) {
    return;
  }
  const fs::path folder = folder_of(target);
  if (!fs::is_directory(folder, ignored)) {
    throw InputError(fmt::format("{}: cannot be written: there is no folder {}", path.string(),
                                 folder.string()));
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw InputError(fmt::format("{}: cannot be written: {}", path.string(), error_text(errno)));
  }
}

}  // namespace transillum
