#include "undine/app/run/checkpoints.hpp"

#include <gtest/gtest.h>

#include "unit/io/io_test.hpp"

namespace undine {
namespace {

using test::sample_frame;
using test::TemporaryFolder;

const std::string wide = rounding_of({.instructions = InstructionSet::avx512});
const std::string narrow = rounding_of({.instructions = InstructionSet::avx2});

TEST(Checkpoints, SayWhatRoundsOtherwise) {
  EXPECT_NE(wide, narrow);
  // The backend of one pair at a time has no vector instructions, whatever the machine has.
  EXPECT_EQ(rounding_of({.kind = BackendKind::serial, .instructions = InstructionSet::avx512}),
            rounding_of({.kind = BackendKind::serial, .instructions = InstructionSet::avx2}));
}

// Criterion: a checkpoint of another machine fits its case, and tells whose it is.
TEST(Checkpoints, AreTakenOfAMachineThatRoundsOtherwise) {
  const TemporaryFolder folder;
  const auto at = [&](const std::string& rounding) {
    return Checkpoints(folder.path(), "spacing=0.1\n", "0123", rounding);
  };
  at(wide).write({sample_frame(3, 2).view()});
  const FoundCheckpoint found = at(narrow).read_newest();
  EXPECT_EQ(found.rounding, wide);
  EXPECT_TRUE(found.refused.empty());
}

// Criterion: two are kept, the newest is taken; one of another case is refused with the key that differs.
TEST(Checkpoints, KeepTheLastTwoAndRefuseAnotherCase) {
  const TemporaryFolder folder;
  const Checkpoints mine(folder.path(), "spacing=0.1\n", "0123", wide);
  auto frame = sample_frame(3, 2);
  for (const std::int64_t step : {8, 9, 10}) {
    frame.step = step;
    mine.write({frame.view()});
  }
  EXPECT_EQ(mine.read_newest().checkpoint.frame.step, 10);
  EXPECT_FALSE(std::filesystem::exists(folder / "step_000000000008.checkpoint"));
  EXPECT_TRUE(std::filesystem::exists(folder / "step_000000000009.checkpoint"));
  const Checkpoints other(folder.path(), "spacing=0.2\n", "4567", wide);
  const std::string error = test::error_of([&] { other.read_newest(); });
  EXPECT_NE(error.find("spacing was 0.1, is 0.2"), std::string::npos) << error;
}

}  // namespace
}  // namespace undine
