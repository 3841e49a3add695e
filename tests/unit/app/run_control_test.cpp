#include <fstream>
#include <future>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "undine/app/run/control.hpp"
#include "undine/io/atomic_file.hpp"
#include "unit/io/io_test.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class RunControlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& text) const { write_text_atomically(folder_ / "control", text); }

  /// As a run between two of its steps, when the last look is long enough ago.
  void obey() {
    std::this_thread::sleep_for(60ms);
    control_.obey(stop_, start_, [this] { told_.push_back(control_.paused()); });
  }

  test::TemporaryFolder place_;  // of its own: tests run side by side
  fs::path folder_ = place_.path() / "run";
  RunControl control_;
  std::atomic<bool> stop_{false};
  RunControl::Clock::time_point start_ = {};
  std::vector<bool> told_;
};

TEST_F(RunControlTest, OnlyARunThatWantsItListens) {
  write("stop");
  control_.begin(folder_, false);
  EXPECT_FALSE(fs::exists(folder_ / "control")) << "what an earlier run left is taken away";
  EXPECT_FALSE(send_run_wish(folder_, "stop"));
  write("stop");
  obey();
  EXPECT_FALSE(stop_);
  EXPECT_FALSE(control_.enabled());
}

TEST_F(RunControlTest, AnOldWishIsForgottenAndTheFileGoesWithTheRun) {
  write("stop");
  {
    RunControl control;
    control.begin(folder_, true);
    EXPECT_EQ(read_text(folder_ / "control"), "run\n");
    control.obey(stop_, start_, [] { FAIL() << "nothing happened"; });
    EXPECT_FALSE(stop_);
  }
  EXPECT_FALSE(fs::exists(folder_ / "control"));
}

TEST_F(RunControlTest, StopIsHeardAtOnceAndOnlyOnceInAWhile) {
  control_.begin(folder_, true);
  obey();
  ASSERT_TRUE(send_run_wish(folder_, "stop"));
  control_.obey(stop_, start_, [] {});
  EXPECT_FALSE(stop_) << "a look at the file costs more than some steps: not before 50 ms have passed";
  obey();
  EXPECT_TRUE(stop_);
  EXPECT_TRUE(told_.empty());
}

TEST_F(RunControlTest, APauseLastsUntilRunAndDoesNotCount) {
  control_.begin(folder_, true);
  ASSERT_TRUE(send_run_wish(folder_, "pause"));
  const auto other = std::async(std::launch::async, [this] {
    std::this_thread::sleep_for(300ms);
    write("");
    std::this_thread::sleep_for(200ms);
    write("halt");
    std::this_thread::sleep_for(200ms);
    write("run and what follows is not read");
  });
  const auto before = RunControl::Clock::now();
  obey();
  const auto waited = RunControl::Clock::now() - before;
  EXPECT_GE(waited, 700ms);
  EXPECT_GE(start_.time_since_epoch(), 600ms);
  EXPECT_LE(start_.time_since_epoch(), waited);
  EXPECT_EQ(told_, (std::vector<bool>{true, false}));
  EXPECT_FALSE(control_.paused());
  EXPECT_FALSE(stop_);
}

TEST_F(RunControlTest, StopAndSignalsEndAPause) {
  for (const bool by_file : {true, false}) {
    stop_ = false;
    control_.begin(folder_, true);
    ASSERT_TRUE(send_run_wish(folder_, "pause"));
    const auto other = std::async(std::launch::async, [&] {
      std::this_thread::sleep_for(200ms);
      by_file ? write("stop") : stop_.store(true);
    });
    obey();
    EXPECT_TRUE(stop_);
    EXPECT_FALSE(control_.paused());
  }
}

TEST_F(RunControlTest, WordsAreThree) {
  for (const auto* word : {"run", "pause", "stop"}) EXPECT_TRUE(is_run_wish(word));
  for (const auto* word : {"", "Run", "stop ", "resume"}) EXPECT_FALSE(is_run_wish(word));
}

}  // namespace
}  // namespace undine
