// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Output files appear complete or not at all: each is written to a temporary file in the target's
// folder, synchronized to disk, and renamed. Where the file system allows it, the temporary file
// has no name before it is complete, so that a killed program leaves nothing behind; but where it
// replaces another, it is named for the moment before it does. Devices and
// files that this process has open already (/dev/stdout) are written to directly.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <ext/stdio_filebuf.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <new>
#include <ostream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum {
namespace {

namespace fs = std::filesystem;

std::string error_text(int error_number) { return std::generic_category().message(error_number); }

std::string reason_text(const fs::path& path, const std::string& reason) {
  return fmt::format("{}: cannot be written: {}", path.string(), reason);
}

/// The number is kept in the exception, for callers whose output is a pipe.
[[noreturn]] void fail(const fs::path& path, int error_number) {
  if (error_number == 0) {
    throw std::runtime_error(reason_text(path, "input/output error"));
  }
  throw std::system_error(error_number, std::generic_category(),
                          path.string() + ": cannot be written");
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// The number of the open file of this process that a path names, as /proc/self/fd/1 does; else -1.
int own_descriptor(const fs::path& path) {
  std::error_code error;
  const fs::path folder = fs::canonical(folder_of(path), error);
  if (error || folder != fs::canonical("/proc/self/fd", error) || error) {
    return -1;
  }
  const std::string name = path.filename().string();
  int descriptor = -1;
  const auto [end, invalid] = std::from_chars(name.data(), name.data() + name.size(), descriptor);
  return invalid == std::errc() && end == name.data() + name.size() ? descriptor : -1;
}

/// The target that a path refers to.
struct Target {
  fs::path path;        ///< the end of its chain of symbolic links; it may not exist
  int descriptor = -1;  ///< the open file of this process that it names, if any
  int error = 0;        ///< why the chain has no end
};

Target target_of(const fs::path& path) {
  constexpr int most_links = 40;  // the limit of Linux
  Target target{path};
  std::error_code error;
  for (int links = 0;; ++links) {
    target.descriptor = own_descriptor(target.path);
    if (target.descriptor >= 0 || !fs::is_symlink(target.path, error)) {
      return target;
    }
    const fs::path next = fs::read_symlink(target.path, error);
    if (error || links == most_links) {
      target.error = error ? error.value() : ELOOP;
      return target;
    }
    target.path = folder_of(target.path) / next;
  }
}

/// An open file, closed by the destructor.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { reset(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  bool open() const { return number_ >= 0; }
  void reset(int number = -1) {
    if (open()) {
      ::close(number_);
    }
    number_ = number;
  }

 private:
  int number_;
};

/// Writes through a copy of `file`, which stays open.
void fill(int file, const fs::path& path, const std::function<void(std::ostream&)>& write) {
  const int copy = ::fcntl(file, F_DUPFD_CLOEXEC, 0);
  if (copy < 0) {
    fail(path, errno);
  }
  __gnu_cxx::stdio_filebuf<char> buffer(copy, std::ios::out | std::ios::binary);
  std::ostream out(&buffer);
  errno = 0;
  try {
    write(out);
  } catch (const std::bad_alloc&) {
    fail(path, ENOMEM);
  }
  out.flush();
  const int error = errno;
  if (!out) {
    fail(path, error);
  }
  if (buffer.close() == nullptr) {
    fail(path, errno);
  }
}

/// A file in the folder of the target, so that the rename stays on one file system. The destructor
/// removes it unless it has replaced the target.
class TemporaryFile {
 public:
  explicit TemporaryFile(fs::path target) : target_(std::move(target)) {
    // A file without a name gets one through /proc.
    if (::access("/proc/self/fd", X_OK) == 0) {
      file_.reset(::open(folder_of(target_).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666));
    }
    if (file_.open()) {
      return;
    }
    create_name([this] {
      file_.reset(::open(path_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666));
      return file_.open();
    });
  }
  ~TemporaryFile() {
    if (!path_.empty()) {
      ::unlink(path_.c_str());
    }
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  int number() const { return file_.number(); }

  void replace_target() {
    synchronize();
    struct stat old {};
    if (::stat(target_.c_str(), &old) == 0) {
      ::fchmod(file_.number(), old.st_mode & 07777);
    }
    if (path_.empty()) {
      const std::string unnamed = fmt::format("/proc/self/fd/{}", file_.number());
      create_name([&] {
        return ::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, path_.c_str(), AT_SYMLINK_FOLLOW) == 0;
      });
    }
    if (::rename(path_.c_str(), target_.c_str()) != 0) {
      fail(target_, errno);
    }
    path_.clear();
  }

 private:
  /// Sets path_ to a new name, for which `create` makes a file.
  template <typename Create>
  void create_name(const Create& create) {
    static std::atomic<unsigned> counter{0};
    do {
      // Short and independent of the target's name, which may have the maximum length.
      path_ = folder_of(target_) / fmt::format(".transillum-{}-{}.tmp", ::getpid(), counter++);
      if (create()) {
        return;
      }
    } while (errno == EEXIST);
    path_.clear();
    fail(target_, errno);
  }

  /// Without this, a crash of the machine could leave the target empty.
  void synchronize() const {
    // Some file systems do not support it; the result is kept all the same.
    if (::fsync(file_.number()) != 0 && errno != EINVAL && errno != ENOTSUP) {
      fail(target_, errno);
    }
  }

  fs::path target_, path_;  ///< path_ is empty while the file has no name
  Descriptor file_;
};

void write_device(const fs::path& device, const fs::path& path,
                  const std::function<void(std::ostream&)>& write) {
  const Descriptor file(::open(device.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC));
  if (!file.open()) {
    fail(path, errno);
  }
  fill(file.number(), path, write);
}

/// Why the target cannot be written to; empty if it can, as far as one can tell before.
std::string obstacle(const Target& target) {
  if (target.error != 0) {
    return error_text(target.error);
  }
  if (target.descriptor >= 0) {
    const int flags = ::fcntl(target.descriptor, F_GETFL);
    return flags < 0 || (flags & O_ACCMODE) == O_RDONLY ? error_text(EBADF) : std::string();
  }
  std::error_code error, ignored;
  const fs::file_status status = fs::status(target.path, error);
  if (error == std::errc::filename_too_long) {
    return error_text(error.value());
  }
  if (fs::is_directory(status)) {
    return "it is a folder";
  }
  // Opening one would block until a reader opens it, and no signal ends the wait.
  if (fs::is_fifo(status)) {
    return "it is a pipe";
  }
  if (fs::is_socket(status)) {
    return "it is a socket";
  }
  if (fs::exists(status) && ::access(target.path.c_str(), W_OK) != 0) {
    return error_text(errno);
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    return {};
  }
  const fs::path folder = folder_of(target.path);
  if (!fs::is_directory(folder, ignored)) {
    return "there is no folder " + folder.string();
  }
  return ::access(folder.c_str(), W_OK | X_OK) == 0 ? std::string() : error_text(errno);
}

/// Whether both paths name one file that exists, or would be one if they were created.
bool is_same_file(const Target& a, const Target& b) {
  std::error_code error;
  if (fs::exists(a.path, error) && fs::exists(b.path, error)) {
    return fs::equivalent(a.path, b.path, error);
  }
  return a.path.filename() == b.path.filename() &&
         fs::equivalent(folder_of(a.path), folder_of(b.path), error);
}

bool is_stream(const Target& target) {
  std::error_code ignored;
  return fs::exists(target.path, ignored) && !fs::is_regular_file(target.path, ignored);
}

}  // namespace

void write_file_whole(const std::filesystem::path& path,
                      const std::function<void(std::ostream&)>& write) {
  const Target target = target_of(path);
  if (target.error != 0) {
    fail(path, target.error);
  }
  if (target.descriptor >= 0) {
    fill(target.descriptor, path, write);
    return;
  }
  std::error_code ignored;
  const fs::file_status status = fs::status(target.path, ignored);
  if (fs::is_directory(status)) {
    fail(path, EISDIR);
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    write_device(target.path, path, write);  // renaming cannot replace a device
    return;
  }
  // Renaming would replace a write-protected file.
  if (fs::exists(status) && ::access(target.path.c_str(), W_OK) != 0) {
    fail(path, errno);
  }
  TemporaryFile temporary(target.path);
  fill(temporary.number(), path, write);
  temporary.replace_target();
}

void check_writable(const std::filesystem::path& path) {
  if (path.empty()) {
    throw InputError("output file: the name is empty");
  }
  const std::string reason = obstacle(target_of(path));
  if (!reason.empty()) {
    throw InputError(reason_text(path, reason));
  }
}

void check_distinct(const std::vector<std::string>& outputs,
                    const std::vector<std::string>& inputs) {
  std::vector<std::pair<std::string, Target>> written;
  for (const std::string& output : outputs) {
    const Target target = target_of(output);
    if (is_stream(target)) {
      continue;
    }
    for (const std::string& input : inputs) {
      if (is_same_file(target, target_of(input))) {
        throw InputError(fmt::format("{}: would overwrite the input file {}", output, input));
      }
    }
    for (const auto& [name, other] : written) {
      if (is_same_file(target, other)) {
        throw InputError(
            fmt::format("{}: given twice as an output file, also as {}", output, name));
      }
    }
    written.emplace_back(output, target);
  }
}

}  // namespace transillum
