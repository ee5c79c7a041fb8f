#include "fairway/base/atomic_file.hpp"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "fairway/base/error.hpp"

namespace fairway {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class AtomicFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = testing::TempDir() + "/atomic-XXXXXX";
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      found.push_back(entry.path().filename().string());
    }
    std::sort(found.begin(), found.end());
    return found;
  }
  using Names = std::vector<std::string>;

  fs::path folder_;
};

TEST_F(AtomicFiles, AppearOnlyAtCommit) {
  AtomicFile file(folder_ / "a", Existing::keep);
  file.write("one ");
  EXPECT_FALSE(fs::exists(folder_ / "a"));
  file.write("two");
  file.commit();
  EXPECT_EQ(content(folder_ / "a"), "one two");
  EXPECT_EQ(names(), Names{"a"});
}

TEST_F(AtomicFiles, WithoutCommitNothingRemains) {
  { AtomicFile(folder_ / "a", Existing::keep).write("half"); }
  EXPECT_EQ(names(), Names{});
}

TEST_F(AtomicFiles, AnExistingFileIsKeptUnlessReplaced) {
  write_whole(folder_ / "a", Existing::keep, "old");
  try {
    write_whole(folder_ / "a", Existing::keep, "new");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), (folder_ / "a").string());
    EXPECT_NE(std::string(error.what()).find("--force"), std::string::npos);
  }
  EXPECT_EQ(content(folder_ / "a"), "old");
  write_whole(folder_ / "a", Existing::replace, "new");
  EXPECT_EQ(content(folder_ / "a"), "new");
  EXPECT_EQ(names(), Names{"a"});
}

TEST_F(AtomicFiles, AFileThatAppearedMeanwhileIsKeptToo) {
  AtomicFile file(folder_ / "a", Existing::keep);
  file.write("ours");
  std::ofstream(folder_ / "a") << "theirs";
  EXPECT_THROW(file.commit(), InputError);
  EXPECT_EQ(content(folder_ / "a"), "theirs");
}

TEST_F(AtomicFiles, PlacesThatCannotHoldAFileAreRefusedAtTheStart) {
  EXPECT_THROW(AtomicFile(folder_ / "missing" / "a", Existing::keep), InputError);
  EXPECT_THROW(AtomicFile(folder_, Existing::replace), InputError);
  EXPECT_THROW(AtomicFile("/dev/null", Existing::replace), InputError);
  EXPECT_THROW(AtomicFile("", Existing::replace), InputError);
  EXPECT_EQ(names(), Names{});
}

TEST_F(AtomicFiles, ThroughASymbolicLinkTheNamedFileIsReplaced) {
  write_whole(folder_ / "real", Existing::keep, "old");
  fs::create_symlink("real", folder_ / "link");
  write_whole(folder_ / "link", Existing::replace, "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(content(folder_ / "real"), "new");
}

// A child process runs `work` and ends in whatever way it ends; returns its wait status.
template <typename Work>
int in_child(const Work& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    work();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

TEST_F(AtomicFiles, AFullDiskLeavesTheOldFileAndNothingElse) {
  write_whole(folder_ / "a", Existing::keep, "old");
  const int status = in_child([&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{64 * 1024, 64 * 1024};  // writes beyond it fail, as on a full disk
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      write_whole(folder_ / "a", Existing::replace, std::string(1 << 20, 'x'));
    } catch (const InputError&) {
      ::_exit(65);
    }
  });
  EXPECT_EQ(WEXITSTATUS(status), 65);
  EXPECT_EQ(content(folder_ / "a"), "old");
  EXPECT_EQ(names(), Names{"a"});
}

TEST_F(AtomicFiles, AKilledProcessLeavesTheOldFileWhole) {
  write_whole(folder_ / "a", Existing::keep, "old");
  const int status = in_child([&] {
    AtomicFile file(folder_ / "a", Existing::replace);
    file.write(std::string(1 << 20, 'x'));
    ::raise(SIGKILL);
  });
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(content(folder_ / "a"), "old");
}

TEST_F(AtomicFiles, AProcessThatEndsOnASignalTidiesUp) {
  in_child([&] {
    AtomicFile file(folder_ / "a", Existing::keep);
    AtomicFolder products(folder_ / "d", Existing::keep, "summary.json", {});
    file.write("half");
    write_whole(products.temporary_path() / "b", Existing::keep, "b");
    remove_unfinished();
    ::_exit(130);
  });
  EXPECT_EQ(names(), Names{});
}

TEST_F(AtomicFiles, ANewFolderAppearsInOneStep) {
  {
    AtomicFolder products(folder_ / "deep" / "out", Existing::keep, "summary.json", {});
    write_whole(products.temporary_path() / "summary.json", Existing::keep, "{}");
    EXPECT_FALSE(fs::exists(folder_ / "deep" / "out"));
    products.commit();
  }
  EXPECT_EQ(content(folder_ / "deep" / "out" / "summary.json"), "{}");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "deep"), {}), 1);
}

TEST_F(AtomicFiles, AFolderWithFilesIsKeptUnlessItsProductsAreReplaced) {
  const fs::path out = folder_ / "out";
  fs::create_directory(out);
  write_whole(out / "notes.txt", Existing::keep, "mine");
  write_whole(out / "summary.json", Existing::keep, "old");
  write_whole(out / "stale.svg", Existing::keep, "of an earlier run");
  EXPECT_THROW(AtomicFolder(out, Existing::keep, "summary.json", {}), InputError);
  {
    AtomicFolder products(out / "", Existing::replace, "summary.json", {"plan", "stale.svg"});
    write_whole(products.temporary_path() / "summary.json", Existing::keep, "new");
    write_whole(products.temporary_path() / "plan", Existing::keep, "p");
    EXPECT_EQ(content(out / "summary.json"), "old");
    products.commit();
  }
  EXPECT_EQ(content(out / "notes.txt"), "mine");
  EXPECT_EQ(content(out / "summary.json"), "new");
  EXPECT_EQ(content(out / "plan"), "p");
  EXPECT_FALSE(fs::exists(out / "stale.svg"));
  EXPECT_EQ(names(), Names{"out"});
}

TEST_F(AtomicFiles, AFileWhereAFolderBelongsIsRefused) {
  write_whole(folder_ / "a", Existing::keep, "file");
  EXPECT_THROW(AtomicFolder(folder_ / "a", Existing::replace, "summary.json", {}), InputError);
  EXPECT_THROW(AtomicFolder(folder_ / "a" / "b", Existing::replace, "summary.json", {}),
               InputError);
}

}  // namespace
}  // namespace fairway
