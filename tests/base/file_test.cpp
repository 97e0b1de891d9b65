#include "sdf/base/file.h"

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <csignal>
#include <functional>
#include <optional>

#include "support/folder.h"

namespace sdf {
namespace file_test {

Status text(std::ostream& out, const std::string& what) {
  out << what;
  return okStatus();
}

std::function<Status(std::ostream&)> writing(const std::string& what) {
  return [what](std::ostream& out) { return text(out, what); };
}

/// Runs `body` in a process of its own, for what would change this one; true if every check in it held.
bool inChild(const std::function<bool()>& body) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(body() ? 0 : 1);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(WriteFile, PutsEveryByteUnderTheName) {
  const Folder folder;
  const std::string large(3'000'001, 'x');  // more than the buffer and more than one piece
  ASSERT_TRUE(writeFile(folder / "a.bin", [&](std::ostream& out) {
    out << "head" << large << "tail";
    return okStatus();
  }));
  EXPECT_EQ(contents(folder / "a.bin"), "head" + large + "tail");
}

TEST(WriteFile, ShowsNothingUnderTheNameBeforeItIsComplete) {
  const Folder folder;
  ASSERT_TRUE(writeFile(folder / "a", [&](std::ostream& out) {
    out << "half" << std::flush;
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
    return okStatus();
  }));
  EXPECT_TRUE(std::filesystem::exists(folder / "a"));
}

TEST(WriteFile, LeavesNothingWhenTheWriterFails) {
  const Folder folder;
  const Status status = writeFile(folder / "a", [](std::ostream& out) -> Status {
    out << "half";
    return Error{ErrorKind::Limits, "too much"};
  });
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::Limits);
  EXPECT_EQ(status.error().message, "too much");
  EXPECT_TRUE(folder.empty());
}

TEST(WriteFile, LeavesAnOlderFileAsItWasWhenTheWriterFails) {
  const Folder folder;
  ASSERT_TRUE(writeFile(folder / "a", writing("old")));
  ASSERT_FALSE(writeFile(folder / "a", [](std::ostream&) -> Status { return Error{ErrorKind::Limits, ""}; }));
  EXPECT_EQ(contents(folder / "a"), "old");
}

TEST(WriteFile, ReplacesAnOlderFile) {
  const Folder folder;
  ASSERT_TRUE(writeFile(folder / "a", writing("a long old text")));
  ASSERT_TRUE(writeFile(folder / "a", writing("new")));
  EXPECT_EQ(contents(folder / "a"), "new");
}

TEST(WriteFile, FollowsSymbolicLinks) {
  const Folder folder;
  std::filesystem::create_directory(folder / "deep");
  std::filesystem::create_symlink("deep/real", folder / "link");
  ASSERT_TRUE(writeFile(folder / "link", writing("text")));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(contents(folder / "deep/real"), "text");
}

TEST(WriteFile, GivesTheFileOrdinaryPermissions) {
  const Folder folder;
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ASSERT_TRUE(writeFile(folder / "a", writing("text")));
  struct stat about;
  ASSERT_EQ(::stat((folder / "a").c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 0777u, 0666u & ~mask);
}

TEST(WriteFile, KeepsThePermissionsOfAnOlderFile) {
  const Folder folder;
  ASSERT_TRUE(writeFile(folder / "a", writing("old")));
  for (const mode_t mode : {0640u, 0600u, 0664u}) {
    ASSERT_EQ(::chmod((folder / "a").c_str(), mode), 0);
    ASSERT_TRUE(writeFile(folder / "a", writing("new")));
    struct stat about;
    ASSERT_EQ(::stat((folder / "a").c_str(), &about), 0);
    EXPECT_EQ(about.st_mode & 0777u, mode);
  }
}

TEST(WriteFile, RemovesWhatAKilledWriterLeft) {
  const Folder folder;
  const bool ended = inChild([&] {
    return writeFile(folder / "a",
                     [](std::ostream&) -> Status {
                       ::raise(SIGKILL);
                       return okStatus();
                     })
        .ok();
  });
  ASSERT_FALSE(ended);
  ASSERT_FALSE(folder.empty());
  ASSERT_TRUE(writeFile(folder / "b", writing("text")));
  std::filesystem::remove(folder / "b");
  EXPECT_TRUE(folder.empty());
}

TEST(WriteFile, LeavesWhatIsBeingWrittenAlone) {
  const Folder folder;
  ASSERT_TRUE(writeFile(folder / "a", [&](std::ostream& out) {
    if (Status s = writeFile(folder / "b", writing("inner")); !s) return s;
    return text(out, "outer");
  }));
  EXPECT_EQ(contents(folder / "a"), "outer");
  EXPECT_EQ(contents(folder / "b"), "inner");
}

TEST(CheckNotRead, RefusesAFileByEveryName) {
  const Folder folder;
  ASSERT_TRUE(writeFile(folder / "read", writing("text")));
  std::filesystem::create_directory(folder / "deep");
  std::filesystem::create_symlink("read", folder / "link");
  std::filesystem::create_hard_link(folder / "read", folder / "hard");
  std::filesystem::create_symlink("missing", folder / "dangling");
  const std::vector<std::string> read{(folder / "read").string(), (folder / "missing").string()};
  for (const char* name : {"read", "link", "hard", "deep/../read", "./read", "missing", "dangling"}) {
    const Status refused = checkNotRead(folder / name, read);
    ASSERT_FALSE(refused) << name;
    EXPECT_EQ(refused.error().kind, ErrorKind::Files);
    EXPECT_NE(refused.error().message.find("choose another name"), std::string::npos);
  }
  EXPECT_TRUE(checkNotRead(folder / "other", read));
  EXPECT_TRUE(checkNotRead(folder / "deep/read", read));
}

TEST(WriteFile, NamesTheMissingFolder) {
  const Folder folder;
  const Status status = writeFile(folder / "none/a.glb", writing("text"));
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::Files);
  EXPECT_EQ(status.error().message,
            "cannot write '" + (folder / "none/a.glb").string() +
                "': No such file or directory; make the folder first or choose another");
}

TEST(WriteFile, RefusesAFolderAsTarget) {
  const Folder folder;
  const Status status = writeFile(folder.path(), writing("text"));
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("Is a directory"), std::string::npos) << status.error().message;
}

// Renaming over /dev/null would take it from everyone.
TEST(WriteFile, LeavesWhatIsNoOrdinaryFileAlone) {
  const Folder folder;
  const auto pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const Status written = writeFile(pipe, [](std::ostream&) { return okStatus(); });
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, ErrorKind::Files);
  EXPECT_NE(written.error().message.find("it is no ordinary file"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST(WriteFile, RefusesAFolderThatMayNotBeWrittenTo) {
  const Folder folder;
  std::filesystem::permissions(folder.path(),
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_TRUE(inChild([&] {
    constexpr uid_t kNobody = 65534;  // the superuser may write anywhere
    if (::geteuid() == 0 && ::setuid(kNobody) != 0) return false;
    const Status status = checkWritable(folder / "a");
    return !status && status.error().kind == ErrorKind::Files &&
           status.error().message.find("Permission denied; choose a folder") != std::string::npos;
  }));
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

TEST(WriteFile, LeavesNothingWhenTheFileGrowsBeyondItsLimit) {
  const Folder folder;
  EXPECT_TRUE(inChild([&] {
    const rlimit limit{1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ::signal(SIGXFSZ, SIG_IGN);
    const Status status = writeFile(folder / "a", writing(std::string(5000, 'x')));
    return !status && status.error().kind == ErrorKind::Files &&
           status.error().message.find("File too large; raise the limit") != std::string::npos;
  }));
  EXPECT_TRUE(folder.empty());
}

TEST(WriteFile, LeavesNothingOnAFullDisk) {
  const Folder folder;
  if (::mount("none", folder.path().c_str(), "tmpfs", 0, "size=64k") != 0)
    GTEST_SKIP() << "mounting needs root";
  const Status status = writeFile(folder / "a", writing(std::string(1 << 20, 'x')));
  const bool empty = folder.empty();
  ::umount(folder.path().c_str());
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::Files);
  EXPECT_NE(status.error().message.find("No space left on device; free some space"), std::string::npos);
  EXPECT_TRUE(empty);
}

void expectInterrupted(const Status& status, const std::filesystem::path& target) {
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::Interrupted);
  EXPECT_EQ(status.error().message, "interrupted; '" + target.string() + "' was not written");
}

TEST(AbandonedWrites, EndTheRunningOnesAtOnceAndAllThatBegin) {
  const Folder folder;
  std::optional<AbandonedWrites> abandoned;
  expectInterrupted(writeFile(folder / "a",
                              [&](std::ostream& out) {
                                out << "half" << std::flush;
                                EXPECT_FALSE(folder.empty());
                                abandoned.emplace();
                                EXPECT_TRUE(folder.empty());
                                EXPECT_FALSE(out << "rest" << std::flush) << "the writer sees it";
                                return okStatus();
                              }),
                    folder / "a");
  expectInterrupted(writeFile(folder / "b", writing("text")), folder / "b");
  EXPECT_TRUE(folder.empty());
}

TEST(AbandonedWrites, LeaveLaterOnesAlone) {
  const Folder folder;
  expectInterrupted(writeFile(folder / "a",
                              [&](std::ostream& out) {
                                { const AbandonedWrites twice, abandoned; }
                                EXPECT_TRUE(writeFile(folder / "b", writing("text")));
                                out << "half";  // of a file that is gone
                                return okStatus();
                              }),
                    folder / "a");
  EXPECT_EQ(contents(folder / "b"), "text");
  EXPECT_FALSE(std::filesystem::exists(folder / "a"));
  EXPECT_TRUE(writeFile(folder / "a", writing("text")));
  EXPECT_EQ(contents(folder / "a"), "text");
}

}  // namespace file_test
}  // namespace sdf
