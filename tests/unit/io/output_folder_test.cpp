#include "undine/io/output_folder.hpp"

#include <limits>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "io_test.hpp"
#include "undine/io/run_record.hpp"

namespace undine {
namespace {

using test::error_of;
using test::read_bytes;
using test::TemporaryFolder;
using test::write_bytes;
namespace fs = std::filesystem;

std::string refusal(const fs::path& folder, FolderMode mode) {
  const std::string error = error_of([&] { const FolderClaim claim = prepare_output_folder(folder, mode); });
  if (!error.empty()) {
    EXPECT_NE(error.find(folder.string()), error.npos) << error;
    EXPECT_NE(error.find("fix: "), error.npos) << error;
  }
  return error;
}

TEST(OutputFolder, FreshMakesNewFoldersOnly) {
  const TemporaryFolder folder;
  EXPECT_EQ(refusal(folder / "a/b/c", FolderMode::fresh), "");
  EXPECT_TRUE(fs::is_directory(folder / "a/b/c"));
  EXPECT_NE(refusal(folder / "a/b/c", FolderMode::fresh), "");  // prepared already
  fs::create_directory(folder / "empty");
  EXPECT_EQ(refusal(folder / "empty", FolderMode::fresh), "");
  write_bytes(folder / "file", "mine");
  EXPECT_NE(refusal(folder / "file", FolderMode::fresh).find("it is a file"), std::string::npos);
  EXPECT_NE(refusal(folder / "file/below", FolderMode::fresh), "");
  EXPECT_NE(refusal(folder.path(), FolderMode::fresh).find("--resume"), std::string::npos);
  EXPECT_EQ(read_bytes(folder / "file"), "mine");
  EXPECT_NE(refusal("", FolderMode::fresh), "");
}

TEST(OutputFolder, RefusesWhereItMayNotWrite) {
  EXPECT_NE(refusal("/proc/undine_out", FolderMode::fresh), "");
  if (geteuid() == 0) GTEST_SKIP() << "the administrator may write anywhere";
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_NE(refusal(folder / "a", FolderMode::fresh).find("Permission denied"), std::string::npos);
  EXPECT_NE(refusal(folder.path(), FolderMode::fresh).find("Permission denied"), std::string::npos);
  fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST(OutputFolder, ResumeKeepsEverything) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal(folder / "missing", FolderMode::resume).find("does not exist"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "missing"));
  EXPECT_NE(refusal(folder.path(), FolderMode::resume).find("empty"), std::string::npos);
  for (const char* name : {"a.checkpoint", "energies.csv", "run.json", "a.checkpoint.tmp", "diagnosis.txt"})
    write_bytes(folder / name, "state");
  EXPECT_EQ(refusal(folder.path(), FolderMode::resume), "");
  for (const char* name : {"a.checkpoint", "energies.csv", "run.json"}) EXPECT_EQ(read_bytes(folder / name), "state");
  EXPECT_FALSE(fs::exists(folder / "a.checkpoint.tmp"));  // half written
  EXPECT_FALSE(fs::exists(folder / "diagnosis.txt"));     // of the run that this one goes on with
}

TEST(OutputFolder, OneRunAtATimeWritesToIt) {
  const TemporaryFolder folder;
  EXPECT_EQ(error_of([&] { FolderClaim::of(folder / "run"); }), "");  // no run wrote there
  EXPECT_FALSE(fs::exists(folder / "run"));
  {
    FolderClaim first = prepare_output_folder(folder / "run", FolderMode::fresh);
    write_bytes(folder / "run" / "a.checkpoint.tmp", "half");
    for (const auto mode : {FolderMode::resume, FolderMode::overwrite})
      EXPECT_NE(refusal(folder / "run", mode).find("another run is writing to it"), std::string::npos);
    EXPECT_NE(error_of([&] { FolderClaim::of(folder / "run"); }), "");
    EXPECT_EQ(read_bytes(folder / "run" / "a.checkpoint.tmp"), "half");
    // Who has it may prepare the folder.
    EXPECT_EQ(error_of([&] { first = prepare_output_folder(folder / "run", FolderMode::resume, std::move(first)); }),
              "");
    EXPECT_NE(refusal(folder / "run", FolderMode::resume), "");
  }
  EXPECT_EQ(refusal(folder / "run", FolderMode::resume), "");
}

TEST(OutputFolder, OverwriteRemovesOnlyWhatARunWrote) {
  const TemporaryFolder folder;
  write_bytes(folder / "thesis.txt", "mine");
  write_bytes(folder / "a.vtkhdf", "old");
  EXPECT_NE(refusal(folder.path(), FolderMode::overwrite), "");
  EXPECT_TRUE(fs::exists(folder / "a.vtkhdf"));

  EXPECT_EQ(refusal(folder / "run", FolderMode::overwrite), "");
  for (const char* name : {"a_0001.vtkhdf", "a.vtkhdf.series", "last.checkpoint", "a.csv.tmp", "notes.txt", "a.csv"})
    write_bytes(folder / "run" / name, "old");
  fs::create_directory(folder / "run" / "sub.vtkhdf");
  fs::create_directory(folder / "run" / "gauges");
  for (const char* name : {"run.json", "progress.json", "energies.csv", "gauges/probe.csv", "gauges/notes.txt"})
    write_bytes(folder / "run" / name, "old");
  EXPECT_EQ(refusal(folder / "run", FolderMode::overwrite), "");
  EXPECT_FALSE(fs::exists(folder / "run" / "a_0001.vtkhdf"));
  EXPECT_FALSE(fs::exists(folder / "run" / "a.vtkhdf.series"));
  EXPECT_FALSE(fs::exists(folder / "run" / "last.checkpoint"));
  EXPECT_FALSE(fs::exists(folder / "run" / "a.csv.tmp"));
  for (const char* name : {"run.json", "progress.json", "energies.csv", "gauges/probe.csv"})
    EXPECT_FALSE(fs::exists(folder / "run" / name)) << name;  // would pass for this run's if it were killed early
  EXPECT_TRUE(fs::exists(folder / "run" / "gauges" / "notes.txt"));
  EXPECT_TRUE(fs::exists(folder / "run" / "notes.txt"));
  EXPECT_TRUE(fs::exists(folder / "run" / "a.csv"));
  EXPECT_TRUE(fs::exists(folder / "run" / "sub.vtkhdf"));
}

TEST(RunRecord, IsWrittenWholeInOrder) {
  const TemporaryFolder folder;
  Json json;
  json["zeta"] = 1;
  json["alpha"] = {1.5, std::numeric_limits<double>::quiet_NaN(), "a\"\n\xff"};
  write_json(folder / "run.json", json);
  EXPECT_EQ(read_bytes(folder / "run.json"),
            "{\n  \"zeta\": 1,\n  \"alpha\": [\n    1.5,\n    null,\n    \"a\\\"\\n\xef\xbf\xbd\"\n  ]\n}\n");
  EXPECT_EQ(to_line(read_json(folder / "run.json")).find("{\"zeta\":1,"), 0u);
  EXPECT_THROW(write_json(folder / "missing/run.json", json), Error);
  EXPECT_FALSE(program_version().empty());
}

}  // namespace
}  // namespace undine
