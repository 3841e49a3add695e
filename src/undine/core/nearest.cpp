#include "undine/core/nearest.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace undine {
namespace {

constexpr std::size_t longest_word = 100;  // longer words are not compared: the cost is quadratic

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same(char a, char b) { return lower(a) == lower(b); }

bool begins_with(std::string_view text, std::string_view start) {
  return start.size() >= 3 && text.size() > start.size() && std::equal(start.begin(), start.end(), text.begin(), same);
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t n = b.size();
  std::vector<int> two_back(n + 1), back(n + 1), row(n + 1);
  for (std::size_t j = 0; j <= n; ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(two_back, back);
    std::swap(back, row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= n; ++j) {
      const int replace = back[j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1);
      row[j] = std::min({replace, back[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]);
      if (swapped) row[j] = std::min(row[j], two_back[j - 2] + 1);
    }
  }
  return row[n];
}

std::string nearest(std::string_view word, const std::vector<std::string>& valid) {
  if (word.empty() || word.size() > longest_word) return {};
  const std::string* best = nullptr;
  std::pair least{std::max(1, static_cast<int>(word.size()) / 3) + 1, 0};  // edits that count, then real edits
  for (const auto& candidate : valid) {
    if (candidate.size() > longest_word) continue;
    const int edits = edit_distance(word, candidate);
    if (edits >= static_cast<int>(std::max(word.size(), candidate.size()))) continue;  // nothing in common
    const bool abbreviated = begins_with(candidate, word) || begins_with(word, candidate);
    const std::pair distance{abbreviated ? 1 : edits, edits};
    if (distance < least) {
      least = distance;
      best = &candidate;
    }
  }
  return best ? *best : std::string();
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& valid) {
  const auto best = nearest(word, valid);
  return best.empty() ? best : "did you mean '" + best + "'?";
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string shortened(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0) == 0x80) --most;
  return std::string(text.substr(0, most)) + "...";
}

}  // namespace undine
