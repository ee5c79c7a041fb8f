// For tests: a contract certificate made with the checker's own images, with equal leaves. (That it
// is accepted shows little; that its mutants are refused, much.)
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "check/contract_flight.hpp"
#include "check/contract_proof.hpp"

namespace fairway_check {

class SmallContractProver {
 public:
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> group;
  std::vector<std::uint8_t> verdict;
  std::vector<float> heading{NAN};
  std::vector<float> time_s{std::numeric_limits<float>::infinity()};

  SmallContractProver(const Parts& parts, const Contract& contract, int leaves_per_side)
      : parts_(parts), contract_(contract), n_(static_cast<std::size_t>(leaves_per_side)) {
    first.push_back(0);
    for (std::size_t s = 0; s < 4 * parts.kind.size(); ++s) {
      const bool has = parts.kind[s / 4] == ordinary && parts.arc[s / 4].width < std::numbers::pi;
      for (std::size_t i = 0; has && i < n_; ++i) {
        begin.push_back(static_cast<std::uint32_t>(i * ((std::uint64_t{1} << 32) / n_)));
        section_.push_back(s);
      }
      first.push_back(static_cast<std::uint32_t>(begin.size()));
    }
    images_.resize(begin.size());
    Behaviours behaviours(parts, contract);
    for (std::size_t leaf = 0; leaf < begin.size(); ++leaf) {
      const std::size_t s = section_[leaf];
      Collect collect(*this, images_[leaf]);
      behaviours.follow_leaf(s / 4, static_cast<int>(s % 4), begin[leaf] * 0x1p-32, end_of(leaf),
                             collect);
    }
    group.assign(begin.size(), 0);
    verdict.assign(begin.size(), undecided);
    decide();
  }

 private:
  struct Link {
    std::uint32_t leaf;
    float least, most, length;
  };
  struct Image {
    std::vector<Link> links;
    unsigned ends = 0;
    double end_length = 0.0;
    bool lost = false;
  };
  struct Collect : Sightings {
    Collect(const SmallContractProver& p, Image& i) : prover(p), image(i) {}
    void cross(std::size_t part, int side, double low, double high, const Past& past) override {
      const std::uint32_t from = prover.first[4 * part + static_cast<std::size_t>(side)];
      const std::uint32_t to = prover.first[4 * part + static_cast<std::size_t>(side) + 1];
      if (from == to) image.lost = true;
      for (std::uint32_t leaf = from; leaf < to; ++leaf) {
        if (prover.begin[leaf] * 0x1p-32 > high + 1e-9 || prover.end_of(leaf) < low - 1e-9)
          continue;
        image.links.push_back({leaf, static_cast<float>(past.least_rad) - 1e-5F,
                               static_cast<float>(past.most_rad) + 1e-5F,
                               static_cast<float>(past.length) + 1e-3F});
      }
    }
    void end(Verdict v, const Past& past) override {
      image.ends |= 1U << v;
      image.end_length = std::max(image.end_length, past.length + 1e-3);
    }
    void give_up() override { image.lost = true; }
    const SmallContractProver& prover;
    Image& image;
  };
  double end_of(std::size_t leaf) const {
    return leaf + 1 < begin.size() && section_[leaf + 1] == section_[leaf]
               ? begin[leaf + 1] * 0x1p-32
               : 1.0;
  }

  /// Tarjan's strongly connected components; each is decided when it is complete, what it leads to
  /// before it.
  void decide() {
    const std::size_t none = ~std::size_t{0};
    std::vector<std::size_t> number(begin.size(), none);
    std::vector<std::size_t> low(begin.size(), 0);
    std::vector<std::size_t> open;
    std::vector<bool> is_open(begin.size(), false);
    std::size_t count = 0;
    struct Frame {
      std::size_t leaf, next;
    };
    std::vector<Frame> calls;
    for (std::size_t root = 0; root < begin.size(); ++root) {
      if (number[root] != none) continue;
      calls.push_back({root, 0});
      while (!calls.empty()) {
        auto& [v, next] = calls.back();
        if (next == 0) {
          number[v] = low[v] = count++;
          open.push_back(v);
          is_open[v] = true;
        }
        if (next < images_[v].links.size()) {
          const std::size_t w = images_[v].links[next++].leaf;
          if (number[w] == none) {
            calls.push_back({w, 0});
          } else if (is_open[w]) {
            low[v] = std::min(low[v], number[w]);
          }
          continue;
        }
        const std::size_t done = v;
        calls.pop_back();
        if (!calls.empty()) low[calls.back().leaf] = std::min(low[calls.back().leaf], low[done]);
        if (low[done] != number[done]) continue;
        std::vector<std::size_t> component;
        do {
          component.push_back(open.back());
          is_open[open.back()] = false;
          open.pop_back();
        } while (component.back() != done);
        decide_component(component);
      }
    }
  }

  void decide_component(const std::vector<std::size_t>& component) {
    unsigned told = 0;
    double onwards = 0.0;
    double least = 0.0;
    double most = 0.0;
    bool inside = false;
    float reference = 0.0F;
    const double seconds = parts_.side_m / contract_.least_speed;
    std::map<std::size_t, bool> in;
    for (const std::size_t leaf : component) in[leaf] = true;
    for (const std::size_t leaf : component) {
      const Image& image = images_[leaf];
      told |= image.ends | (image.lost ? 1U << undecided : 0U);
      onwards = std::max(onwards, image.end_length * seconds);
      for (const Link& link : image.links) {
        if (in.contains(link.leaf)) {
          const float middle = 0.5F * (link.least + link.most);
          if (!inside) reference = middle;
          const double off =
              std::remainder(static_cast<double>(middle - reference), 2.0 * std::numbers::pi);
          const double half = 0.5 * static_cast<double>(link.most - link.least);
          least = inside ? std::min(least, off - half) : off - half;
          most = inside ? std::max(most, off + half) : off + half;
          inside = true;
        } else {
          told |= 1U << verdict[link.leaf];
          onwards = std::max(onwards, static_cast<double>(link.length) * seconds +
                                          static_cast<double>(time_s[group[link.leaf]]));
        }
      }
    }
    const bool progress = !inside || most - least < std::numbers::pi - 4e-3;
    const bool one = told == 1U << reach || told == 1U << collide || told == 1U << leave;
    if (!one || !progress) return;
    const auto u = static_cast<float>(std::remainder(
        static_cast<double>(reference) + 0.5 * (least + most), 2.0 * std::numbers::pi));
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (const std::size_t leaf : component) {
      verdict[leaf] = static_cast<std::uint8_t>(std::countr_zero(told));
      group[leaf] = static_cast<std::uint32_t>(heading.size());
      const Cell part = parts_.part_at(section_[leaf] / 4);
      const Shape ends =
          places_on(static_cast<int>(section_[leaf] % 4), begin[leaf] * 0x1p-32, end_of(leaf));
      for (const Point p : ends.corners()) {
        const double along = parts_.side_m * ((part.x + p.x) * std::cos(static_cast<double>(u)) +
                                              (part.y + p.y) * std::sin(static_cast<double>(u)));
        low = std::min(low, along);
        high = std::max(high, along);
      }
    }
    const double way =
        inside ? (high - low + 1e-3) / contract_.least_speed / std::cos(0.5 * (most - least) + 1e-4)
               : 0.0;
    heading.push_back(inside ? u : NAN);
    time_s.push_back(static_cast<float>((way + onwards) * 1.001));
  }

  const Parts& parts_;
  const Contract& contract_;
  std::size_t n_;
  std::vector<std::size_t> section_;
  std::vector<Image> images_;
};

}  // namespace fairway_check
