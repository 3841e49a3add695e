#include "undine/engine/plan.hpp"

#include <stdexcept>

namespace undine {

Resources& Resources::add(Group group, const FieldSet& fields) {
  for (int f = 0; f < FieldId::count; ++f)
    if (fields[f]) bits_.set(f * group_count + static_cast<int>(group));
  return *this;
}

Resources Resources::without(const Resources& other) const {
  Resources r = *this;
  r.bits_ &= ~other.bits_;
  return r;
}

Resources Resources::common(const Resources& other) const {
  Resources r = *this;
  r.bits_ &= other.bits_;
  return r;
}

std::string Resources::text() const {
  std::string text;
  for (int f = 0; f < FieldId::count; ++f)
    for (int g = 0; g < group_count; ++g)
      if (bits_[f * group_count + g])
        text += (text.empty() ? "" : ", ") + std::string(all_fields[f].name) + (g == 0 ? "(fluid)" : "(wall)");
  return text;
}

FieldSet Resources::fields() const {
  FieldSet fields;
  for (int f = 0; f < FieldId::count; ++f)
    for (int g = 0; g < group_count; ++g)
      if (bits_[f * group_count + g]) fields.set(f);
  return fields;
}

bool Plan::must_precede(const Stage& first, const Stage& second) {
  const Resources first_only_writes = first.writes.without(first.reads);
  const Resources second_only_reads = second.reads.without(second.writes);
  const Resources second_changes = second.writes.common(second.reads);
  const Resources first_changes = first.writes.common(first.reads);
  return first_only_writes.overlaps(second.reads) || first_only_writes.overlaps(second_changes) ||
         first_changes.overlaps(second_only_reads);
}

void Plan::order(const Resources& given) {
  std::vector<Stage> ordered;
  std::vector<char> done(stages_.size(), 0);
  Resources known = given;
  while (ordered.size() < stages_.size()) {
    std::size_t next = stages_.size();
    for (std::size_t s = 0; s < stages_.size() && next == stages_.size(); ++s) {
      if (done[s]) continue;
      bool ready = true;
      for (std::size_t other = 0; other < stages_.size(); ++other)
        if (other != s && !done[other] && must_precede(stages_[other], stages_[s])) ready = false;
      if (ready) next = s;
    }
    if (next == stages_.size()) {
      std::string names;
      for (std::size_t s = 0; s < stages_.size(); ++s)
        if (!done[s]) names += (names.empty() ? "" : ", ") + stages_[s].name;
      throw std::logic_error("these stages wait for each other: " + names);
    }
    const Stage& stage = stages_[next];
    if (const auto unknown = stage.reads.without(known); !unknown.empty())
      throw std::logic_error("stage '" + stage.name + "' reads what nothing writes: " + unknown.text());
    known.add(stage.writes);
    done[next] = 1;
    ordered.push_back(stage);
  }
  stages_ = std::move(ordered);
}

void Plan::run() const {
  for (const auto& stage : stages_) stage.run();
}

std::vector<Resources> Plan::fresh_reads() const {
  std::vector<Resources> fresh;
  for (std::size_t s = 0; s < stages_.size(); ++s) {
    Resources written;
    for (std::size_t e = 0; e < s; ++e) written.add(stages_[e].writes);
    fresh.push_back(stages_[s].reads.common(written));
  }
  return fresh;
}

}  // namespace undine
