#include "experiments/io/whole_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <fcntl.h>
#include <iterator>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace irradiff {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class WholeFileTest : public testing::Test {
 protected:
  WholeFileTest() {
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("irradiff-" + std::to_string(getpid()) + "-" + test.name());
    fs::create_directory(folder_);
  }
  ~WholeFileTest() override { fs::remove_all(folder_); }

  static std::string contentOf(const fs::path& path) {
    std::ifstream stream(path);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  static void write(const fs::path& path, const std::string& content) {
    WholeFile file(path);
    file.stream() << content;
    file.commit();
  }

  std::ptrdiff_t fileCount() const { return std::distance(fs::directory_iterator(folder_), {}); }

  fs::path folder_;
};

TEST_F(WholeFileTest, AppearsWhenCommitted) {
  const fs::path path = folder_ / "result.json";
  WholeFile file(path);
  file.stream() << "whole";
  file.stream().flush();
  EXPECT_FALSE(fs::exists(path));
  file.commit();
  EXPECT_EQ(contentOf(path), "whole");
  EXPECT_EQ(fileCount(), 1);
}

TEST_F(WholeFileTest, LeavesNothingBehindUnlessCommitted) {
  { WholeFile(folder_ / "result.json").stream() << "half"; }
  EXPECT_EQ(fileCount(), 0);
}

TEST_F(WholeFileTest, KeepsTheOldContentUnlessCommitted) {
  const fs::path path = folder_ / "result.json";
  write(path, "old");
  { WholeFile(path).stream() << "half"; }
  EXPECT_EQ(contentOf(path), "old");
  write(path, "new");
  EXPECT_EQ(contentOf(path), "new");
  EXPECT_EQ(fileCount(), 1);
}

TEST_F(WholeFileTest, TwoWritersOfOnePathDoNotMix) {
  const fs::path path = folder_ / "result.json";
  WholeFile first(path);
  WholeFile second(path);
  first.stream() << "first";
  second.stream() << "second";
  first.commit();
  EXPECT_EQ(contentOf(path), "first");
  second.commit();
  EXPECT_EQ(contentOf(path), "second");
  EXPECT_EQ(fileCount(), 1);
}

TEST_F(WholeFileTest, FollowsALink) {
  write(folder_ / "real.json", "old");
  fs::create_symlink("real.json", folder_ / "link.json");
  write(folder_ / "link.json", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.json"));
  EXPECT_EQ(contentOf(folder_ / "real.json"), "new");
}

// A pipe stands for every device: a writer that goes wrong here must not be able to replace one of the machine's.
TEST_F(WholeFileTest, WritesIntoAPipeAndDoesNotReplaceIt) {
  const fs::path path = folder_ / "pipe";
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  const int reader = open(path.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  write(path, "through");
  std::array<char, 16> received{};
  const ssize_t count = read(reader, received.data(), received.size());
  close(reader);
  EXPECT_EQ(std::string(received.data(), count > 0 ? static_cast<std::size_t>(count) : 0), "through");
  EXPECT_TRUE(fs::is_fifo(path));
}

// The system refuses to let files of this process grow beyond a limit for as long as this lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_action_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_limit_);
    const rlimit limit{bytes, old_limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_action_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*old_action_)(int);
  rlimit old_limit_{};
};

TEST_F(WholeFileTest, LeavesNothingBehindWhereItCannotBeWrittenWhole) {
  const fs::path path = folder_ / "result.json";
  for (const std::size_t size : {5000, 500000}) {  // fails in commit, and before it
    const FileSizeLimit limit(4096);
    EXPECT_THAT([&] { write(path, std::string(size, 'x')); },
                ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("cannot write"), HasSubstr("result.json"))));
    EXPECT_EQ(fileCount(), 0);
  }
}

TEST_F(WholeFileTest, NamesThePathAndTheReason) {
  EXPECT_THAT([&] { WholeFile(folder_ / "missing" / "result.json"); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("cannot write "), HasSubstr("missing/result.json"),
                                                      HasSubstr("No such file or directory"))));
  EXPECT_THAT([&] { WholeFile(folder_.string()); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr(folder_.string()), HasSubstr("it is a folder"))));
}

}  // namespace
}  // namespace irradiff
