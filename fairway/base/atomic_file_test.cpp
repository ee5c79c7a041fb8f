#include "fairway/base/atomic_file.hpp"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
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

TEST_F(AtomicFiles, AnOutputThatIsAnInputIsRefusedUnderAnyName) {
  write_whole(folder_ / "in", Existing::keep, "in");
  write_whole(folder_ / "other", Existing::keep, "in");
  fs::create_symlink("in", folder_ / "link");
  fs::create_hard_link(folder_ / "in", folder_ / "hard");
  const std::vector<fs::path> inputs{folder_ / "absent", folder_ / "in"};
  for (const char* name : {"in", "./in", "link", "hard"}) {
    EXPECT_THROW(require_no_input(folder_ / name, inputs), InputError) << name;
  }
  EXPECT_NO_THROW(require_no_input(folder_ / "other", inputs));
  EXPECT_NO_THROW(require_no_input(folder_ / "new", inputs));
  EXPECT_NO_THROW(require_no_input(folder_ / "absent", inputs));
}

TEST_F(AtomicFiles, ThroughASymbolicLinkTheNamedFileIsReplaced) {
  write_whole(folder_ / "real", Existing::keep, "old");
  fs::create_symlink("real", folder_ / "link");
  write_whole(folder_ / "link", Existing::replace, "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(content(folder_ / "real"), "new");
}

// Runs `work` in a child process and returns its wait status, however it ends.
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

/// A set of products that belong together: each file contains `mark`.
void write_set(const AtomicFolder& products, const std::string& mark, int count) {
  for (int i = 0; i < count; ++i) {
    write_whole(products.temporary_path() / std::to_string(i), Existing::keep, mark);
  }
  write_whole(products.temporary_path() / "summary.json", Existing::keep, mark);
}

TEST_F(AtomicFiles, AFolderThatFillsMeanwhileIsNotTouched) {
  const fs::path out = folder_ / "out";
  for (const bool was_there : {false, true}) {
    fs::remove_all(out);
    if (was_there) fs::create_directory(out);
    {
      AtomicFolder products(out, Existing::keep, "summary.json", {"0", "1", "summary.json"});
      write_set(products, "ours", 1);
      fs::create_directory(out);
      std::ofstream(out / "summary.json") << "theirs";
      std::ofstream(out / "1") << "theirs";
      EXPECT_THROW(products.commit(), InputError);
    }
    EXPECT_EQ(content(out / "summary.json"), "theirs");
    EXPECT_EQ(content(out / "1"), "theirs");
    EXPECT_FALSE(fs::exists(out / "0"));
    EXPECT_EQ(names(), Names{"out"});
  }
}

TEST_F(AtomicFiles, AnEmptyFolderThatAppearsMeanwhileIsFilledAndStaysTheSame) {
  const fs::path out = folder_ / "out";
  AtomicFolder products(out, Existing::keep, "summary.json", {});
  write_set(products, "ours", 2);
  fs::create_directory(out);
  fs::permissions(out, fs::perms::owner_all);
  products.commit();
  EXPECT_EQ(content(out / "summary.json"), "ours");
  EXPECT_EQ(fs::status(out).permissions(), fs::perms::owner_all);
  EXPECT_EQ(names(), Names{"out"});
}

TEST_F(AtomicFiles, AFileThatAppearsInThePlaceOfAFolderIsKept) {
  for (const Existing existing : {Existing::keep, Existing::replace}) {
    AtomicFolder products(folder_ / "out", existing, "summary.json", {});
    write_set(products, "ours", 1);
    std::ofstream(folder_ / "out") << "theirs";
    EXPECT_THROW(products.commit(), InputError);
    EXPECT_EQ(content(folder_ / "out"), "theirs");
    fs::remove(folder_ / "out");
  }
}

TEST_F(AtomicFiles, AFolderInThePlaceOfAProductStopsAllBeforeAnythingIsReplaced) {
  const fs::path out = folder_ / "out";
  const std::vector<std::string> all{"0", "stale", "summary.json"};
  for (const std::string in_the_way : {"0", "stale", "summary.json"}) {
    fs::remove_all(out);
    fs::create_directory(out);
    for (const std::string& name : all) std::ofstream(out / name) << "old";
    fs::remove(out / in_the_way);
    fs::create_directory(out / in_the_way);
    EXPECT_THROW(AtomicFolder(out, Existing::replace, "summary.json", all), InputError);
    fs::remove(out / in_the_way);
    {
      AtomicFolder products(out, Existing::replace, "summary.json", all);
      write_set(products, "new", 1);
      fs::create_directory(out / in_the_way);
      EXPECT_THROW(products.commit(), InputError);
    }
    EXPECT_TRUE(fs::remove(out / in_the_way));  // the folder
    for (const std::string& name : all) {
      EXPECT_EQ(content(out / name), name == in_the_way ? "" : "old") << name;
    }
    EXPECT_EQ(names(), Names{"out"});
  }
}

TEST_F(AtomicFiles, OfTwoAtOnceIntoANewPlaceOneWinsAndTheOtherTakesNothing) {
  const fs::path out = folder_ / "out";
  for (int round = 0; round < 30; ++round) {
    fs::remove_all(out);
    if (round % 2 == 1) fs::create_directory(out);
    std::atomic<int> ready{0};
    std::atomic<int> committed{0};
    const auto run = [&](const std::string& mark, int count) {
      AtomicFolder products(out, Existing::keep, "summary.json", {"0", "1", "2", "summary.json"});
      write_set(products, mark, count);
      ++ready;
      while (ready < 2) std::this_thread::yield();
      try {
        products.commit();
        ++committed;
      } catch (const InputError&) {
      }
    };
    std::thread one(run, "a", 3);
    std::thread other(run, "b", 1);
    one.join();
    other.join();
    ASSERT_EQ(committed, 1);
    const std::string winner = content(out / "summary.json");
    EXPECT_EQ(content(out / "0"), winner);
    EXPECT_EQ(fs::exists(out / "2"), winner == "a");
    EXPECT_EQ(names(), Names{"out"});
  }
}

TEST_F(AtomicFiles, OfTwoAtOnceThatReplaceOneWholeSetIsLeft) {
  const fs::path out = folder_ / "out";
  for (int round = 0; round < 30; ++round) {
    fs::remove_all(out);
    if (round % 3 > 0) fs::create_directory(out);
    if (round % 3 > 1) std::ofstream(out / "1") << "old";
    std::atomic<int> ready{0};
    const auto run = [&](const std::string& mark, int count) {
      AtomicFolder products(out, Existing::replace, "summary.json",
                            {"0", "1", "2", "summary.json"});
      write_set(products, mark, count);
      ++ready;
      while (ready < 2) std::this_thread::yield();
      products.commit();
    };
    std::thread one(run, "a", 3);
    std::thread other(run, "b", 1);
    one.join();
    other.join();
    const std::string last = content(out / "summary.json");
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(content(out / std::to_string(i)), last == "a" || i < 1 ? last : "") << i;
    }
    EXPECT_EQ(names(), Names{"out"});
  }
}

TEST_F(AtomicFiles, TheNextIntoAPlaceSweepsWhatAKilledProcessLeft) {
  in_child([&] {
    AtomicFile file(folder_ / "a", Existing::keep);
    AtomicFolder products(folder_ / "d", Existing::keep, "summary.json", {});
    write_set(products, "half", 2);
    ::raise(SIGKILL);
  });
  EXPECT_EQ(names().size(), 2U);
  write_whole(folder_ / "a", Existing::keep, "a");
  { const AtomicFolder products(folder_ / "d", Existing::keep, "summary.json", {}); }
  EXPECT_EQ(names(), Names{"a"});
}

TEST_F(AtomicFiles, WhatALiveProcessWritesIsNeverSwept) {
  const std::string alive = ".a.partial-" + std::to_string(::getppid()) + "-0";
  const std::string others = ".b.partial-999999999-0";  // no such process, under another name
  const std::string not_ours = ".a.partial-999999999-x";
  for (const std::string& name : {alive, others, not_ours}) std::ofstream(folder_ / name) << "x";
  // No process with that id, but its lock is held: by another machine or container.
  const std::string elsewhere = ".a.partial-999999999-7";
  std::ofstream(folder_ / elsewhere) << "x";
  const int lock = ::open((folder_ / elsewhere).c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(::flock(lock, LOCK_EX | LOCK_NB), 0);
  AtomicFile mine(folder_ / "a", Existing::keep);
  write_whole(folder_ / "a", Existing::keep, "a");  // another one from this process, meanwhile
  EXPECT_TRUE(fs::exists(mine.temporary_path()));
  for (const std::string& name : {alive, others, not_ours, elsewhere}) {
    EXPECT_TRUE(fs::exists(folder_ / name)) << name;
  }
  ::close(lock);
  write_whole(folder_ / "a", Existing::replace, "a");
  EXPECT_FALSE(fs::exists(folder_ / elsewhere));
}

TEST_F(AtomicFiles, WhatWasLeftUnderOurOwnProcessIdIsRemovedToo) {  // as in containers
  const std::string stale = ".a.partial-" + std::to_string(::getpid()) + "-999999";
  std::ofstream(folder_ / stale) << "x";
  write_whole(folder_ / "a", Existing::keep, "a");
  EXPECT_EQ(names(), Names{"a"});
}

}  // namespace
}  // namespace fairway
