#pragma once
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

namespace undine {

struct ReportOptions {
  std::filesystem::path folder;  ///< of a run or a study
  std::filesystem::path out;     ///< empty: report.html in the folder
  double megabytes = 20;         ///< largest size; what does not fit is thinned out, and the page says so
};

struct WrittenReport {
  std::filesystem::path file;
  std::size_t bytes = 0;
  std::vector<std::string> notes;  ///< what was left out
};

/// Writes a page that shows a run or a study, with everything in it, so that it opens without a network. For a study
/// also the reports of those members that lack one. Throws InputError, Error.
WrittenReport write_report(const ReportOptions& options);

/// `undine report`: the same, and says what was written.
int report_command(const ReportOptions& options);

/// viewer/dist/page.html, which the build puts into the program.
std::string_view report_page();
/// viewer/colour_maps.json, likewise.
std::string_view colour_maps_json();

}  // namespace undine
