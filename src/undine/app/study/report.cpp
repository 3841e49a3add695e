#include "undine/app/study/report.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "undine/io/run_record.hpp"

namespace undine::study {
namespace {

/// A cell of a CSV file: text with commas or quotes in quotes.
std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_number(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

/// A cell of a markdown table.
std::string md_cell(const std::string& text) {
  std::string cell;
  for (const char c : text) cell += c == '|' ? std::string("\\|") : c == '\n' ? std::string(" ") : std::string(1, c);
  return cell;
}

std::string md_number(double value) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return "never";
  return fmt::format("{:.4g}", value);
}

std::string md_row(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + md_cell(cell) + " |";
  return line + "\n";
}

/// "tight" or "tight (published: leaks, DISAGREES)"
std::string beside(const std::string& ours, const std::string& name, const Row& row) {
  const auto published = row.published.find(name);
  if (published == row.published.end()) return ours;
  const auto agrees = row.agrees.find(name);
  return fmt::format("{} (published {}{})", ours, published->second,
                     agrees == row.agrees.end() ? ""
                     : agrees->second           ? ", agrees"
                                                : ", DISAGREES");
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

class Writer {
 public:
  Writer(const StudyFile& study, const std::vector<Member>& members)
      : study_(study),
        members_(members),
        table_(tabulate(study, members)),
        first_(RunFacts::names().size() + study.axes.size()) {}

  std::string csv() const {
    std::string text = "member";
    for (const Axis& axis : study_.axes) text += "," + csv_cell(axis.name);
    text += ",status,seconds,particles,steps";
    for (const Quantity& quantity : study_.quantities)
      text +=
          "," + csv_cell(quantity.unit.empty() ? quantity.name : fmt::format("{} [{}]", quantity.name, quantity.unit));
    for (const Verdict& verdict : study_.verdicts) text += "," + csv_cell(verdict.name);
    text += ",error\n";
    for (std::size_t k = 0; k < members_.size(); ++k) {
      const Member& member = members_[k];
      text += csv_cell(member.name);
      for (std::size_t a = 0; a < study_.axes.size(); ++a) text += "," + csv_cell(value_name(member, a));
      text += fmt::format(",{},{},{},{}", word(member.status), member.facts.wall_time, member.facts.particles,
                          member.facts.steps);
      for (std::size_t q = 0; q < study_.quantities.size(); ++q)
        text += "," + csv_number(table_.rows[k].values[first_ + q]);
      for (const std::string& verdict : table_.rows[k].verdicts) text += "," + csv_cell(verdict);
      text += "," + csv_cell(member.error) + "\n";
    }
    return text;
  }

  std::string markdown() const {
    std::string text = fmt::format("# {}\n\n", study_.title.empty() ? study_.file.filename().string() : study_.title);
    text += fmt::format("`{}`, Undine {}.\n\n", study_.command, program_version());
    std::vector<std::string> head;
    for (const Axis& axis : study_.axes) head.push_back(axis.name);
    if (head.empty()) head.emplace_back("member");
    head.emplace_back("status");
    for (const Quantity& quantity : study_.quantities)
      head.push_back(quantity.unit.empty() ? quantity.name : fmt::format("{} [{}]", quantity.name, quantity.unit));
    for (const Verdict& verdict : study_.verdicts) head.push_back(verdict.name);
    text += md_row(head) + md_row(std::vector<std::string>(head.size(), "---"));
    for (std::size_t k = 0; k < members_.size(); ++k) text += md_row(cells(k));
    return text + meanings() + orders() + limits() + notes();
  }

  Json json() const {
    Json axes = Json::array(), quantities = Json::array(), verdicts = Json::array(), members = Json::array(),
         orders = Json::array();
    for (const Axis& axis : study_.axes) {
      Json values = Json::array();
      for (const AxisValue& value : axis.values) values.push_back(value.name);
      axes.push_back({{"name", axis.name}, {"values", values}});
    }
    for (const Quantity& quantity : study_.quantities)
      quantities.push_back({{"name", quantity.name}, {"unit", quantity.unit}, {"meaning", quantity.meaning}});
    for (const Verdict& verdict : study_.verdicts)
      verdicts.push_back({{"name", verdict.name}, {"rule", verdict.text()}});
    for (std::size_t k = 0; k < members_.size(); ++k) members.push_back(member_json(k));
    for (const Order& order : table_.orders)
      orders.push_back(
          {{"quantity", order.quantity}, {"axis", order.axis}, {"group", order.group}, {"order", number(order.order)}});
    Json limits = Json::array();
    for (const Score& score : judge_limits(study_, members_, table_)) limits.push_back(score_json(score));
    return Json{
        {"title", study_.title},    {"file", study_.file.string()}, {"command", study_.command}, {"axes", axes},
        {"quantities", quantities}, {"verdicts", verdicts},         {"members", members},        {"orders", orders},
        {"limits", limits}};
  }

 private:
  const std::string& value_name(const Member& member, std::size_t a) const {
    return study_.axes[a].values[member.choice[a]].name;
  }

  std::vector<std::string> cells(std::size_t k) const {
    const Member& member = members_[k];
    const Row& row = table_.rows[k];
    std::vector<std::string> all;
    for (std::size_t a = 0; a < study_.axes.size(); ++a) all.push_back(value_name(member, a));
    if (all.empty()) all.push_back(member.name);
    all.push_back(member.status == Status::went_bad ? fmt::format("went bad at {:.4g} s", member.facts.time)
                                                    : word(member.status));
    for (std::size_t q = 0; q < study_.quantities.size(); ++q)
      all.push_back(beside(md_number(row.values[first_ + q]), study_.quantities[q].name, row));
    for (std::size_t v = 0; v < study_.verdicts.size(); ++v)
      all.push_back(beside(row.verdicts[v], study_.verdicts[v].name, row));
    return all;
  }

  std::string meanings() const {
    std::string text;
    for (const Quantity& quantity : study_.quantities)
      if (!quantity.meaning.empty()) text += fmt::format("- `{}`: {}\n", quantity.name, quantity.meaning);
    for (const Verdict& verdict : study_.verdicts) text += fmt::format("- **{}**: {}\n", verdict.name, verdict.text());
    return text.empty() ? "" : "\n" + text;
  }

  std::string orders() const {
    if (table_.orders.empty()) return {};
    std::string text =
        "\n" + md_row({"quantity", "axis", "group", "observed order"}) + md_row({"---", "---", "---", "---"});
    for (const Order& order : table_.orders) {
      std::string group;
      for (const auto& [axis, value] : order.group) group += (group.empty() ? "" : ", ") + axis + " = " + value;
      text += md_row({order.quantity, order.axis, group, md_number(order.order)});
    }
    return text;
  }

  std::string limits() const {
    const auto scores = judge_limits(study_, members_, table_);
    if (scores.empty()) return {};
    std::string text =
        "\n" + md_row({"metric", "value", "limit", "kept", "source"}) + md_row({"---", "---", "---", "---", "---"});
    for (const Score& score : scores)
      text += md_row({score.metric, md_number(score.value), score.limit_text(), score.kept_text(), score.source});
    return text;
  }

  /// Why we differ from what was published, and what failed.
  std::string notes() const {
    std::string text;
    for (std::size_t k = 0; k < members_.size(); ++k) {
      for (const std::string& reason : table_.rows[k].reasons)
        text += fmt::format("- {}: {}\n", members_[k].name, reason);
      if (!members_[k].error.empty())
        text += fmt::format("- {}: {}: {}\n", members_[k].name, word(members_[k].status), members_[k].error);
    }
    return text.empty() ? "" : "\n" + text;
  }

  Json member_json(std::size_t k) const {
    const Member& member = members_[k];
    const Row& row = table_.rows[k];
    Json axes = Json::object(), quantities = Json::object(), verdicts = Json::object(), published = Json::object(),
         agrees = Json::object();
    for (std::size_t a = 0; a < study_.axes.size(); ++a) axes[study_.axes[a].name] = value_name(member, a);
    for (std::size_t q = 0; q < study_.quantities.size(); ++q)
      quantities[study_.quantities[q].name] = number(row.values[first_ + q]);
    for (std::size_t v = 0; v < study_.verdicts.size(); ++v) verdicts[study_.verdicts[v].name] = row.verdicts[v];
    for (const auto& [name, text] : row.published) {
      published[name] = text;
      const auto found = row.agrees.find(name);
      agrees[name] = found == row.agrees.end() ? Json(nullptr) : Json(found->second);
    }
    return Json{{"name", member.name},
                {"folder", member.folder.filename().string()},
                {"axes", axes},
                {"status", word(member.status)},
                {"error", member.error},
                {"seconds", member.facts.wall_time},
                {"particles", member.facts.particles},
                {"steps", member.facts.steps},
                {"quantities", quantities},
                {"verdicts", verdicts},
                {"published", published},
                {"agrees", agrees},
                {"reasons", row.reasons}};
  }

  const StudyFile& study_;
  const std::vector<Member>& members_;
  ResultTable table_;
  std::size_t first_;  ///< of the quantities among a row's values
};

}  // namespace

Json score_json(const Score& score) {
  return Json{{"metric", score.metric},
              {"value", number(score.value)},
              {"limit", number(score.limit)},
              {"bound", score.limited() ? (score.is_upper ? "at most" : "at least") : ""},
              {"pass", score.limited() ? Json(score.pass()) : Json(nullptr)},
              {"unit", score.unit},
              {"source", score.source}};
}

std::string score_row(const std::string& name, const Score& score) {
  return md_row({name, score.metric, md_number(score.value) + (score.unit.empty() ? "" : " " + score.unit),
                 score.limit_text(), score.kept_text(), score.source});
}

void write_report(const StudyFile& study, const std::vector<Member>& members, const std::filesystem::path& folder) {
  const Writer writer(study, members);
  write_text_atomically(folder / "results.csv", writer.csv());
  write_text_atomically(folder / "study.md", writer.markdown());
  write_json(folder / "study.json", writer.json());
}

}  // namespace undine::study
