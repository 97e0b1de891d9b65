#include "sdf/base/file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <mutex>
#include <set>
#include <streambuf>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace sdf {
namespace {

namespace fs = std::filesystem;

class TemporaryFile;

// Of files that are being written: .sdf-1234-0.part.
constexpr const char* kUnfinishedName = ".sdf-";
constexpr const char* kUnfinishedExtension = ".part";

/// The files that are being written. Renaming and removing happen under its lock, so that none slips through.
struct Unfinished {
  std::mutex mutex;
  std::set<TemporaryFile*> files;
  int abandonments = 0;  ///< AbandonedWrites that live
};

Unfinished& unfinished() {
  static Unfinished files;
  return files;
}

const char* adviceFor(int reason) {
  switch (reason) {
    case ENOSPC:
    case EDQUOT:
      return "free some space or choose another folder";
    case EFBIG:
      return "raise the limit on file sizes (ulimit -f) or write less, e.g. with larger voxels";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder that you may write to";
    case ENOENT:
    case ENOTDIR:
      return "make the folder first or choose another";
    case ENAMETOOLONG:
      return "choose a shorter name";
    default:
      return "choose another folder";
  }
}

Error cannotWrite(const fs::path& target, int reason) {
  return {ErrorKind::Files, "cannot write '" + target.string() +
                                "': " + std::generic_category().message(reason) + "; " + adviceFor(reason)};
}

Error interrupted(const fs::path& target) {
  return {ErrorKind::Interrupted, "interrupted; '" + target.string() + "' was not written"};
}

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// Where the bytes of `target` belong: at the end of the symbolic links that start there. (Canonical paths of
/// the standard library do not follow a link to a file yet to be made.)
fs::path resolved(fs::path target) {
  constexpr int kMostLinks = 40;  // Linux follows no more either (path_resolution(7))
  std::error_code ignored;
  for (int i = 0; i < kMostLinks && fs::is_symlink(target, ignored); ++i) {
    target = folderOf(target) / fs::read_symlink(target, ignored);
  }
  return target;
}

/// Buffered writing to a file descriptor that keeps the first error's reason, which std::filebuf loses.
class DescriptorBuffer : public std::streambuf {
 public:
  DescriptorBuffer(int descriptor, const std::atomic<bool>& abandoned)
      : descriptor_(descriptor), abandoned_(abandoned) {
    setp(buffer_.data(), buffer_.data() + buffer_.size());
  }
  int reason() const { return reason_; }

 protected:
  int_type overflow(int_type c) override {
    if (sync() != 0) return traits_type::eof();
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    return sputc(traits_type::to_char_type(c));
  }

  int sync() override {
    for (const char* data = pbase(); data < pptr() && reason_ == 0;) {
      if (abandoned_) reason_ = EINTR;
      const ssize_t written = reason_ == 0 ? ::write(descriptor_, data, pptr() - data) : 0;
      if (written < 0 && errno != EINTR) reason_ = errno;
      if (written > 0) data += written;
    }
    setp(buffer_.data(), buffer_.data() + buffer_.size());
    return reason_ == 0 ? 0 : -1;
  }

 private:
  int descriptor_;
  const std::atomic<bool>& abandoned_;
  int reason_ = 0;
  std::vector<char> buffer_ = std::vector<char>(1 << 20);  // an interruption is noticed each time it is full
};

/// Removes files that no writer holds any more: those of programs that were killed.
void removeLeftovers(const fs::path& folder) {
  std::error_code ignored;
  for (fs::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(kUnfinishedName) || !name.ends_with(kUnfinishedExtension)) continue;
    const int file = ::open(entry->path().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
    if (file < 0) continue;
    if (::flock(file, LOCK_EX | LOCK_NB) == 0) ::unlink(entry->path().c_str());
    ::close(file);
  }
}

/// A new file in the folder of `target`, with a name that nothing there has, locked while it is written;
/// removed unless it was renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) {
    static std::atomic<unsigned> counter{0};
    std::lock_guard lock(unfinished().mutex);
    if (unfinished().abandonments > 0) {
      abandoned_ = true;
      return;
    }
    removeLeftovers(folderOf(target));
    do {
      if (descriptor_ >= 0) ::close(descriptor_);
      path_ = (folderOf(target) / (std::string(kUnfinishedName) + std::to_string(::getpid()) + "-" +
                                   std::to_string(counter++) + kUnfinishedExtension))
                  .string();
      descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 ? errno == EEXIST : !claim());
    reason_ = descriptor_ < 0 ? errno : 0;
    if (reason_ == 0) unfinished().files.insert(this);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    std::lock_guard lock(unfinished().mutex);
    if (unfinished().files.erase(this) > 0) ::unlink(path_.c_str());
  }

  int descriptor() const { return descriptor_; }
  /// Lets those read and write it who may read and write `target`, if that is there.
  void takePermissions(const fs::path& target) {
    struct stat about;
    if (::stat(target.c_str(), &about) == 0) ::fchmod(descriptor_, about.st_mode & 07777);
  }
  /// errno of what failed, or 0.
  int reason() const { return reason_; }
  const std::atomic<bool>& abandoned() const { return abandoned_; }

  /// Removes the file before it is finished, under the lock of unfinished().
  void abandon() {
    abandoned_ = true;
    ::unlink(path_.c_str());
  }

  /// Gives the file its name. Some file systems report a failed write only when the file is closed.
  int renameTo(const fs::path& target) {
    const int locked = ::dup(descriptor_);  // for as long as it has the name of an unfinished one
    const int reason = ::close(std::exchange(descriptor_, -1)) != 0 ? errno : named(target);
    if (locked >= 0) ::close(locked);
    return reason;
  }

 private:
  int named(const fs::path& target) {
    std::lock_guard lock(unfinished().mutex);
    if (abandoned_) return EINTR;
    if (::rename(path_.c_str(), target.c_str()) != 0) return errno;
    unfinished().files.erase(this);
    return 0;
  }

  // Locks the file; false if somebody took it for a leftover before. Some file systems know no locks.
  bool claim() const {
    struct stat about;
    ::flock(descriptor_, LOCK_EX | LOCK_NB);
    return ::fstat(descriptor_, &about) != 0 || about.st_nlink > 0;
  }

  std::string path_;
  std::atomic<bool> abandoned_ = false;
  int descriptor_ = -1;
  int reason_ = 0;
};

}  // namespace

std::string lowerExtension(const fs::path& name) {
  std::string extension = name.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

Status checkExtension(const fs::path& name, std::span<const std::string_view> known) {
  if (std::ranges::find(known, lowerExtension(name)) != known.end()) return okStatus();
  const std::string extension = name.extension().string();
  std::string message = "'" + name.string() + "' has ";
  message += extension.empty() ? "no extension" : "the unknown extension '" + extension + "'";
  message += known.size() == 1 ? "; the output's name must end in" : "; the output's name must end in one of";
  for (const std::string_view one : known) message.append(" ").append(one);
  return Error{ErrorKind::Usage, std::move(message)};
}

Status checkWritable(const fs::path& target) {
  if (!target.has_filename()) return cannotWrite(target, EISDIR);
  const fs::path real = resolved(target);
  struct stat about;
  if (::stat(real.c_str(), &about) == 0) {
    if (S_ISDIR(about.st_mode)) return cannotWrite(target, EISDIR);
    if (!S_ISREG(about.st_mode))  // renaming would put a file in the place of a device or a pipe
      return Error{ErrorKind::Files,
                   "cannot write '" + target.string() + "': it is no ordinary file; choose another name"};
    if (::access(real.c_str(), W_OK) != 0) return cannotWrite(target, errno);
  }
  if (::stat(folderOf(real).c_str(), &about) != 0) return cannotWrite(target, errno);
  if (!S_ISDIR(about.st_mode)) return cannotWrite(target, ENOTDIR);
  if (::access(folderOf(real).c_str(), W_OK | X_OK) != 0) return cannotWrite(target, errno);
  return okStatus();
}

bool areOneFile(const fs::path& a, const fs::path& b) {
  std::error_code missing, ignored;
  if (fs::equivalent(a, b, missing)) return true;
  return fs::weakly_canonical(resolved(a), ignored) == fs::weakly_canonical(resolved(b), ignored);
}

Status checkNotRead(const fs::path& target, std::span<const std::string> read) {
  for (const std::string& file : read)
    if (areOneFile(target, file))
      return Error{ErrorKind::Files, "cannot write '" + target.string() + "': '" + file +
                                         "', which is read, is the same file; choose another name"};
  return okStatus();
}

Status writeFile(const fs::path& target, const std::function<Status(std::ostream&)>& write) {
  if (Status possible = checkWritable(target); !possible) return possible;
  const fs::path real = resolved(target);
  TemporaryFile file(real);
  if (file.abandoned()) return interrupted(target);
  if (file.reason() != 0) return cannotWrite(target, file.reason());
  file.takePermissions(real);

  DescriptorBuffer buffer(file.descriptor(), file.abandoned());
  std::ostream stream(&buffer);
  Status written = write(stream);
  stream.flush();
  if (file.abandoned()) return interrupted(target);
  if (buffer.reason() != 0) return cannotWrite(target, buffer.reason());
  if (!written) return written;
  if (!stream) return cannotWrite(target, EIO);

  const int reason = file.renameTo(real);
  if (file.abandoned()) return interrupted(target);
  if (reason != 0) return cannotWrite(target, reason);
  return okStatus();
}

AbandonedWrites::AbandonedWrites() {
  std::lock_guard lock(unfinished().mutex);
  ++unfinished().abandonments;
  for (TemporaryFile* file : std::exchange(unfinished().files, {})) file->abandon();
}

AbandonedWrites::~AbandonedWrites() {
  std::lock_guard lock(unfinished().mutex);
  --unfinished().abandonments;
}

}  // namespace sdf
