#pragma once
#include <bitset>
#include <functional>
#include <string>
#include <vector>

#include "undine/engine/store.hpp"

namespace undine {

/// Fields of certain groups: what a stage reads or writes.
class Resources {
 public:
  Resources() = default;
  /// The fields of one group.
  Resources(Group group, const FieldSet& fields) { add(group, fields); }

  Resources& add(Group group, const FieldSet& fields);
  Resources& add(const Resources& other) {
    bits_ |= other.bits_;
    return *this;
  }
  bool overlaps(const Resources& other) const { return (bits_ & other.bits_).any(); }
  Resources without(const Resources& other) const;
  Resources common(const Resources& other) const;
  bool empty() const { return bits_.none(); }
  /// "rho(fluid), p(wall)".
  std::string text() const;
  /// The fields of all groups together.
  FieldSet fields() const;

 private:
  std::bitset<FieldId::count * group_count> bits_;
};

/// One step of an evaluation: a sweep over pairs or an update of particles.
struct Stage {
  std::string name;
  Resources reads, writes;
  std::function<void()> run;
};

/// Stages in an order derived from what they read and write: who reads a field comes after who writes it. A stage that
/// reads and writes the same field changes it in place, after those that only write it and before those that only read
/// it.
class Plan {
 public:
  void add(Stage stage) { stages_.push_back(std::move(stage)); }
  /// Orders the stages (those free to swap keep the order in which they were added). `given` exists before the first
  /// stage. Throws std::logic_error naming the stages of a cycle, or a field that is read but neither given nor
  /// written.
  void order(const Resources& given);
  void run() const;

  const std::vector<Stage>& stages() const { return stages_; }
  /// What each stage of the ordered plan reads from earlier stages; with several ranks, what must be exchanged before
  /// it.
  std::vector<Resources> fresh_reads() const;

 private:
  static bool must_precede(const Stage& first, const Stage& second);
  std::vector<Stage> stages_;
};

}  // namespace undine
