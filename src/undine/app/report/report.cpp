#include "undine/app/report/report.hpp"

#include <fmt/format.h>

#include "undine/app/report/blocks.hpp"
#include "undine/app/report/run_data.hpp"
#include "undine/app/report/study_data.hpp"
#include "undine/core/error.hpp"
#include "undine/io/atomic_file.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view place_of_data = "<!--UNDINE-DATA-->";
constexpr int most_tries = 4;
constexpr std::size_t reserve = 100'000;  ///< bytes for what the plan of a page does not count

/// JSON that can stand in a page: "<" would end the element that holds it, where "/script" follows.
std::string embedded(const Json& data) {
  const std::string text = to_line(data);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) c == '<' ? safe += "\\u003c" : safe += c;
  return safe;
}

std::string page_with(Json data, const Blocks& blocks) {
  const std::string_view page = report_page();
  const std::size_t at = page.rfind(place_of_data);
  data["blocks"] = blocks.infos();
  std::string text(page.substr(0, at));
  text += "<script type=\"application/json\" id=\"undine-data\">" + embedded(data) + "</script>\n";
  for (std::size_t k = 0; k < blocks.texts().size(); ++k)
    if (!blocks.texts()[k].empty())
      text += fmt::format("<script type=\"text/plain\" id=\"b{}\">{}</script>\n", k, blocks.texts()[k]);
  return text.append(page.substr(at + place_of_data.size()));
}

WrittenReport write_page(const fs::path& file, const Json& data, const std::string& text) {
  write_text_atomically(file, text);
  return {file, text.size(), data["notes"].get<std::vector<std::string>>()};
}

WrittenReport write_run(const ReportOptions& options, const fs::path& file) {
  const RunFolder run = RunFolder::open(options.folder);
  const auto limit = static_cast<std::size_t>(options.megabytes * 1e6);
  const std::size_t fixed = report_page().size() + reserve;
  if (limit <= fixed)
    throw InputError(
        {.what = fmt::format("a report cannot be as small as {:.3g} MB", options.megabytes),
         .why = fmt::format("the page without any data takes {:.2g} MB", static_cast<double>(fixed) * 1e-6),
         .fix = "give a larger --max-mb"});
  // What a page takes is foreseen from two snapshots; where that was too little, it is made anew with less room.
  std::size_t room = limit - fixed;
  for (int tries = 1;; ++tries) {
    Blocks blocks;
    const Json data = run_data(run, room, blocks);
    const std::string text = page_with(data, blocks);
    if (text.size() <= limit || tries == most_tries) return write_page(file, data, text);
    room = static_cast<std::size_t>(0.95 * static_cast<double>(room) * static_cast<double>(limit) /
                                    static_cast<double>(text.size()));
  }
}

}  // namespace

WrittenReport write_report(const ReportOptions& options) {
  const fs::path file = options.out.empty() ? options.folder / "report.html" : options.out;
  if (!fs::is_regular_file(options.folder / "study.json")) return write_run(options, file);
  for (const fs::path& member : study_members(options.folder))
    if (!fs::exists(member / "report.html"))
      write_run({.folder = member, .out = {}, .megabytes = options.megabytes}, member / "report.html");
  const Json data = study_data(options.folder);
  return write_page(file, data, page_with(data, {}));
}

int report_command(const ReportOptions& options) {
  const WrittenReport report = write_report(options);
  for (const std::string& note : report.notes) fmt::print("{}\n", note);
  fmt::print("{}, {:.1f} MB\n", report.file.string(), static_cast<double>(report.bytes) * 1e-6);
  return 0;
}

}  // namespace undine
