#include <algorithm>
#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "undine/app/approximate/approximate.hpp"
#include "undine/app/bench/bench.hpp"
#include "undine/app/bench/search.hpp"
#include "undine/app/exact.hpp"
#include "undine/app/lists.hpp"
#include "undine/app/picture/picture_command.hpp"
#include "undine/app/report/report.hpp"
#include "undine/app/run/options.hpp"
#include "undine/app/run/spinning.hpp"
#include "undine/app/study/study.hpp"
#include "undine/app/study/verify.hpp"
#include "undine/app/tell.hpp"
#include "undine/app/view/view.hpp"
#include "undine/core/error.hpp"
#include "undine/core/nearest.hpp"
#include "undine/io/checksum.hpp"
#include "undine/io/run_record.hpp"

namespace {

using namespace undine;

void add_case_options(CLI::App& command, RunOptions& options) {
  command.add_option("case", options.file, "case file (TOML)")->required();
  command.add_option("--set", options.sets, "override a key: --set time.end=\"2 s\"")->allow_extra_args(false);
  command.add_option("--threads", options.threads, "threads; 0: all cores")->check(CLI::Range(0, 1024));
  command.add_option("--out", options.out, "output folder");
}

void add_study_options(CLI::App& command, StudyOptions& options) {
  command.add_option("study", options.file, "study file (TOML)")->required();
  command.add_option("--out", options.out, "output folder; out/NAME unless given");
  command.add_option("--set", options.sets, "override a key in every member: --set time.end=\"2 s\"")
      ->allow_extra_args(false);
  command.add_option("--only", options.only, "run only the members whose name fits this pattern (* and ?)");
  command.add_option("--jobs", options.jobs, "members at a time; 0: as many as there are cores")
      ->check(CLI::Range(0, 1024));
  command.add_flag("--quick", options.quick, "the reduced study of the file's [quick]");
  command.add_flag("--dry-run", options.dry_run, "list the members with particles, steps and estimated time");
  command.add_flag("--again", options.again, "also run members that are finished");
  command.add_flag("--json", options.json, "progress as one JSON object per line");
}

void add_verify_options(CLI::App& command, VerifyOptions& options) {
  command.add_option("names", options.names, "verifications, or patterns of them (* and ?); all that are not long");
  command.add_option("--files", options.files, "folder of studies; those that come with the program unless given");
  command.add_option("--out", options.out, "folder of the runs; out/verify unless given");
  command.add_option("--jobs", options.jobs, "members at a time; 0: as many as there are cores")
      ->check(CLI::Range(0, 1024));
  command.add_flag("--quick", options.quick, "the part that takes less than a minute");
  command.add_flag("--list", options.list, "list the verifications with members and estimated time; run nothing");
  command.add_flag("--json", options.json, "print an array of objects with case, metric, value, limit, pass");
  command.add_flag("--again", options.again, "also run members that this program has finished");
}

int execute(int argc, char** argv) {
  CLI::App app{"Undine: smoothed particle hydrodynamics, every ingredient chosen in a case file"};
  app.set_version_flag("--version", std::string(program_version()));
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 internal error, 2 bad input, 3 the run went bad, 4 output could not be written, 5 "
      "verified and "
      "a limit was missed, 130 "
      "interrupted (checkpoint written).");

  RunOptions run_options;
  bool quiet = false, json = false;
  auto* run = app.add_subcommand("run", "run a case");
  add_case_options(*run, run_options);
  run->add_flag("--resume", run_options.resume, "go on from the newest checkpoint of the output folder");
  run->add_flag("--overwrite", run_options.overwrite, "replace an earlier run in the output folder");
  run->add_flag("--control", run_options.control,
                "let `undine view` pause and stop it, and whoever writes DIR/control");
  run->add_flag("!--no-report", run_options.report, "write no report.html at the end");
  run->add_flag("--quiet", quiet, "print errors only");
  run->add_flag("--json", json, "progress as one JSON object per line");

  RunOptions check_options;
  auto* check = app.add_subcommand("check", "read a case with everything it names, and say what it resolves to");
  add_case_options(*check, check_options);

  StudyOptions study_options;
  auto* study = app.add_subcommand("study", "run a family of cases and judge it in one table");
  add_study_options(*study, study_options);

  VerifyOptions verify_options;
  auto* verify = app.add_subcommand("verify", "run what has an exact or published answer, and score it in one table");
  add_verify_options(*verify, verify_options);

  std::string axis, name;
  bool list_json_flag = false, markdown = false;
  auto* list = app.add_subcommand("list", "list the choices of an axis, or the axes");
  list->add_option("axis", axis, "kernels, pressure, walls, ...");
  list->add_flag("--json", list_json_flag, "for machines");
  list->add_flag("--markdown", markdown, "for the docs; all axes when none is named");
  auto* show = app.add_subcommand("show", "equation, citation, reads, adds and parameters of an entry");
  show->add_option("name", name, "name, or axis/name")->required();

  std::filesystem::path file;
  auto* sum =
      app.add_subcommand("checksum", "hash over all fields of a snapshot or checkpoint, in order of particle id");
  sum->add_option("file", file)->required();

  ExactOptions exact_options;
  auto* exact = app.add_subcommand("exact", "a table of an exact solution, as CSV");
  exact->add_option("name", exact_options.name, "riemann, sedov, ...; see `undine list exact`")->required();
  exact->add_option("--set", exact_options.sets, "parameter=value, as often as needed")->allow_extra_args(false);
  exact->add_option("--at", exact_options.at, "a point: 0.2, \"2 mm\" or 0.2,0.1; as often as needed")
      ->allow_extra_args(false);
  exact->add_option("--from", exact_options.from, "first point of a line of points");
  exact->add_option("--to", exact_options.to, "last point of it");
  exact->add_option("--points", exact_options.points, "how many points it has (101)")->check(CLI::PositiveNumber);
  exact->add_option("--time", exact_options.time, "a number in s, or with a unit");
  exact->add_option("--out", exact_options.out, "a CSV file; without it the table is printed");
  ApproximateOptions approximate_options;
  auto* approximate =
      app.add_subcommand("approximate", "fields and derivatives at other points, from scattered points");
  add_approximate_options(*approximate, approximate_options);
  ReportOptions report_options;
  auto* report = app.add_subcommand("report", "write a page that shows a run or a study, with everything in it");
  report->add_option("folder", report_options.folder, "of a run or a study")->required();
  report->add_option("-o,--out", report_options.out, "file; report.html in the folder unless said");
  report->add_option("--max-mb", report_options.megabytes, "largest size in MB (20); what does not fit is thinned out")
      ->check(CLI::Range(1.0, 1000.0));

  ViewOptions view_options;
  auto* view = app.add_subcommand("view", "show a run, also while it goes on, to a browser on this machine");
  view->add_option("folder", view_options.folder, "of a run")->required();
  view->add_flag("--follow", view_options.follow, "go on to each new snapshot");
  view->add_option("--port", view_options.port, "to listen on; any free one unless said")->check(CLI::Range(0, 65535));
  view->add_option("--host", view_options.host, "address to listen on (127.0.0.1); others let other machines in");

  PictureOptions picture_options;
  auto* picture = app.add_subcommand("picture", "draw the particles of a run, as a picture or a movie");
  add_picture_options(*picture, picture_options);

  BenchOptions bench_options;
  auto* bench = app.add_subcommand("bench", "time the hot loops on this machine");
  add_bench_options(*bench, bench_options);
  BenchSearchOptions bench_search_options;
  const auto* bench_search = add_bench_search(*bench, bench_search_options);

  if (argc > 1 && argv[1][0] != '-') {
    std::vector<std::string> commands;
    for (const auto* command : app.get_subcommands({})) commands.push_back(command->get_name());
    if (std::ranges::count(commands, argv[1]) == 0)
      throw InputError({.what = fmt::format("there is no command '{}'", shortened(argv[1], 40)),
                        .why = "commands are " + listed(commands),
                        .fix = did_you_mean(argv[1], commands) + " see `undine --help`"});
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_ok : exit_input;
  }
  run_options.verbosity = json ? Verbosity::json : quiet ? Verbosity::quiet : Verbosity::normal;
  if ((run->parsed() && run_options.threads != 1) || approximate->parsed() || bench->parsed()) bound_spinning(argv);
  if (run->parsed()) return run_case(run_options);
  if (check->parsed()) return check_case(check_options);
  if (study->parsed()) return run_study(study_options);
  if (verify->parsed()) return run_verify(verify_options);
  if (list->parsed()) {
    if (axis.empty()) {
      fmt::print("{}", markdown ? docs_tables() : list_axes());
    } else {
      fmt::print("{}", list_json_flag ? list_json(axis) : markdown ? list_markdown(axis) : list_text(axis));
    }
  }
  if (show->parsed()) fmt::print("{}", show_text(name));
  if (sum->parsed()) fmt::print("{}\n", checksum_file(file));
  if (bench_search->parsed()) return run_bench_search(bench_search_options);
  if (exact->parsed()) return run_exact(exact_options);
  if (approximate->parsed()) return run_approximate(approximate_options);
  if (report->parsed()) return report_command(report_options);
  if (view->parsed()) return view_command(view_options);
  if (picture->parsed()) return picture_command(picture_options);
  if (bench->parsed()) return run_bench(bench_options);
  return exit_ok;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return execute(argc, argv);
  } catch (const InputError& error) {
    tell(stderr, "error: {}\n", error.what());
    return exit_input;
  } catch (const RunError& error) {
    tell(stderr, "error: {}\n", error.what());
    return exit_run;
  } catch (const Error& error) {
    tell(stderr, "error: {}\n", error.what());
    return exit_output;
  } catch (const std::exception& error) {
    tell(stderr, "internal error: {}\n", error.what());
    return exit_internal;
  }
}
