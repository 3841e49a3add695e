#pragma once
#include <string>
#include <vector>

#include "undine/app/gauges/gauge.hpp"

namespace undine::gauges {

template <int N>
class WallForce : public Gauge<N> {
 public:
  static constexpr Info info{"wall_force", "Force and moment of the fluid on the walls, or on one of them",
                             "F = sum_w m_w acc_w, M = sum_w (x_w - about) x m_w acc_w; in 2-D for 1 m of width",
                             "reaction to the forces of walls on the fluid"};

  WallForce(const Table& table, const GaugeContext<N>& context)
      : where_(table.where()), about_(read_point<N>(table, "about", Vec<N>{})) {
    if (context.bodies.empty() && !context.body_of_id.empty())
      table.fail("type", "there are no wall particles to push on", "force is summed over wall particles",
                 "choose a wall treatment with particles, or leave this gauge out");
    if (!table.has("wall")) return;
    std::vector<std::string> names;
    for (const auto& [name, body] : context.bodies) names.push_back(name);
    if (names.empty()) table.fail("wall", "no wall of this case has a name", {}, "name it there, or leave out 'wall'");
    wall_ = table.choice("wall", names);
    const int body = context.bodies.at(wall_);
    one_body_ = true;
    for (const int each : context.body_of_id) of_body_.push_back(each == body);
  }

  bool needs_wall_forces() const override { return true; }

  std::vector<SeriesColumn> columns() const override {
    std::vector<SeriesColumn> all;
    for (const std::string& axis : axes<N>()) all.push_back({"f" + axis, "N"});
    for (int k = first_moment; k < 3; ++k) all.push_back({"m" + all_axes[static_cast<std::size_t>(k)], "N m"});
    return all;
  }

  std::vector<double> read(const Flow<N>& flow) const override {
    const auto x = flow.store().template get<field::x>();
    const auto m = flow.store().template get<field::m>();
    const auto acc = flow.store().template get<field::acc>();
    const auto ids = flow.store().ids();
    const auto* mirrors = flow.options().mirrors.get();
    const auto counts = [&](std::int64_t id) {
      if (!one_body_) return true;
      if (mirrors) return mirrors->wall(Ghosts<N>::mirror_of(id)) == wall_;
      return static_cast<std::size_t>(id) < of_body_.size() && of_body_[static_cast<std::size_t>(id)];
    };
    const Total total = total_over(flow.store(), Group::wall, [&](std::size_t i) {
      if (!counts(ids[i])) return Total{};
      const Vec<N> force = m[i] * acc[i];
      return Total{force, cross(widen(x[i] - about_), widen(force)), 1};
    });
    const auto& options = flow.options();
    if ((total.particles == 0 && !mirrors) || (options.wall_density == walls::WallDensity::none && !options.repulsion))
      throw InputError(
          {.what = "this gauge finds no wall particles to measure the force on",
           .where = where_,
           .why = "only walls made of particles that press on the fluid feel a force",
           .fix = "choose such walls ('combined', 'wall_particles', 'modified_density') or remove the gauge"});
    std::vector<double> row(total.force.c, total.force.c + N);
    row.insert(row.end(), total.moment.c + first_moment, total.moment.c + 3);
    return row;
  }

 private:
  static constexpr int first_moment = N == 3 ? 0 : N == 2 ? 2 : 3;

  struct Total {
    Vec<N> force{};
    Vec<3> moment{};
    double particles = 0;
    Total& operator+=(const Total& o) {
      force += o.force;
      moment += o.moment;
      particles += o.particles;
      return *this;
    }
  };

  SourceLocation where_;
  Vec<N> about_;
  bool one_body_ = false;
  std::string wall_;           ///< its name
  std::vector<char> of_body_;  ///< by particle id
};

}  // namespace undine::gauges
