#include "undine/geometry/span.hpp"

#include <algorithm>

namespace undine {
namespace {

constexpr double same_fraction = 1e-14;

void add_unless_thin(Spans& spans, const Span& span, double thin) {
  const bool rounding = span.begin_cut && span.end_cut && span.end - span.begin <= thin;
  if (span.end > span.begin && !rounding) spans.push_back(span);
}

}  // namespace

Spans convex_spans(const Cut& in, const Cut& out) {
  if (!(in.at < out.at) || out.at <= 0 || in.at >= 1) return {};
  Span span;
  if (in.at > 0) span.begin = in.at, span.begin_cut = true, span.begin_normal = in.normal;
  if (out.at <= 1) span.end = out.at, span.end_cut = true, span.end_normal = out.normal;
  return {span};
}

Spans spans_from_cuts(std::vector<Cut> cuts, const Vec3& direction, const std::function<bool(double)>& inside) {
  std::erase_if(cuts, [](const Cut& cut) { return !(cut.at >= 0 && cut.at <= 1); });
  std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.at < b.at; });
  Spans spans;
  bool open = inside(cuts.empty() ? 0.5 : 0.5 * cuts.front().at);
  if (!cuts.empty() && cuts.front().at <= same_fraction) open = false;
  if (open) spans.push_back({});
  for (std::size_t first = 0; first < cuts.size();) {
    // Crossings at one place (an edge, a vertex) count as one; the side after it decides what it is.
    std::size_t last = first;
    while (last + 1 < cuts.size() && cuts[last + 1].at - cuts[first].at <= same_fraction) ++last;
    const double next = last + 1 < cuts.size() ? cuts[last + 1].at : 1.0;
    const bool after = next > cuts[last].at ? inside(0.5 * (cuts[last].at + next)) : false;
    const auto along = [&](const Cut& a, const Cut& b) { return dot(a.normal, direction) < dot(b.normal, direction); };
    const auto group =
        std::make_pair(cuts.begin() + static_cast<long>(first), cuts.begin() + static_cast<long>(last) + 1);
    const double at = cuts[first].at;
    if (!open && after) {
      spans.push_back({at, 1, at > 0, false, std::min_element(group.first, group.second, along)->normal, {}});
    } else if (open && !after) {
      spans.back().end = at;
      spans.back().end_cut = true;
      spans.back().end_normal = std::max_element(group.first, group.second, along)->normal;
    }
    open = after;
    first = last + 1;
  }
  return spans;
}

Spans both_spans(const Spans& a, const Spans& b, double thin) {
  Spans both;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    Span s = a[i];
    // Of two coinciding ends the cut one counts.
    const bool begin_b = b[j].begin > s.begin || (b[j].begin == s.begin && b[j].begin_cut);
    if (begin_b) s.begin = b[j].begin, s.begin_cut = b[j].begin_cut, s.begin_normal = b[j].begin_normal;
    const bool end_b = b[j].end < s.end || (b[j].end == s.end && b[j].end_cut);
    if (end_b) s.end = b[j].end, s.end_cut = b[j].end_cut, s.end_normal = b[j].end_normal;
    add_unless_thin(both, s, thin);
    if (a[i].end < b[j].end) {
      ++i;
    } else {
      ++j;
    }
  }
  return both;
}

Spans other_spans(const Spans& a, double thin) {
  Spans other;
  Span gap;
  bool open = true;
  for (const Span& s : a) {
    gap.end = s.begin;
    gap.end_cut = s.begin_cut;
    gap.end_normal = -s.begin_normal;
    add_unless_thin(other, gap, thin);
    gap = {s.end, 1, s.end_cut, false, -s.end_normal, {}};
    open = s.end_cut;
  }
  if (open) add_unless_thin(other, gap, thin);
  return other;
}

}  // namespace undine
