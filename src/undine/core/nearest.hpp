#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace undine {

/// Number of single-letter insertions, deletions, replacements and swaps of neighbours that turn `a` into `b` (the
/// optimal string alignment form of the Damerau-Levenshtein distance); upper and lower case count as the same letter.
int edit_distance(std::string_view a, std::string_view b);

/// The entry of `valid` that `word` was probably meant to be: the least edit distance, at most a third of the word's
/// length (and always one edit), or a word that begins with the other. The first of equals; empty if nothing is close.
std::string nearest(std::string_view word, const std::vector<std::string>& valid);

/// "did you mean 'spacing'?", or an empty string if nothing is close.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& valid);

/// "a, b, c"
std::string listed(const std::vector<std::string>& words);

/// The text, or its first `most` bytes (whole UTF-8 characters) and "..." if it is longer; for quoting input in
/// messages.
std::string shortened(std::string_view text, std::size_t most);

}  // namespace undine
