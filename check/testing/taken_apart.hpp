// For tests: a certificate file taken apart, changed, and put together again.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "check/flight.hpp"
#include "check/tensors.hpp"

namespace fairway_check {

/// A certificate file taken apart, to be changed and reassembled.
struct TakenApart {
  nlohmann::json header;
  nlohmann::json record;
  std::map<std::string, std::string> arrays;
  std::map<std::string, std::size_t> places;  // where they begin

  explicit TakenApart(const std::string& file) {
    std::uint64_t length = 0;
    std::memcpy(&length, file.data(), 8);
    header = nlohmann::json::parse(file.substr(8, length));
    record = nlohmann::json::parse(header["__metadata__"]["fairway"].get<std::string>());
    for (const auto& [name, entry] : header.items()) {
      if (name == "__metadata__") continue;
      const std::size_t begin = entry["data_offsets"][0];
      const std::size_t end = entry["data_offsets"][1];
      places[name] = begin;
      arrays[name] = file.substr(8 + length + begin, end - begin);
    }
  }
  template <typename T>
  T at(const char* name, std::size_t i) const {
    T value;
    std::memcpy(&value, arrays.at(name).data() + i * sizeof(T), sizeof(T));
    return value;
  }
  template <typename T>
  void put(const char* name, std::size_t i, T value) {
    std::memcpy(arrays.at(name).data() + i * sizeof(T), &value, sizeof(T));
  }
  std::size_t leaves() const { return arrays.at("leaf_verdict").size(); }
  std::size_t section_of(std::size_t leaf) const {
    std::size_t s = 0;
    while (at<std::uint32_t>("section_first", s + 1) <= leaf) ++s;
    return s;
  }
  /// The last leaf for which `good` holds.
  std::size_t find(const std::function<bool(std::size_t)>& good) const {
    for (std::size_t leaf = leaves(); leaf-- > 0;) {
      if (good(leaf)) return leaf;
    }
    ADD_FAILURE() << "no such leaf";
    return 0;
  }
  std::size_t leaf_with(Verdict verdict) const {
    return find(
        [&](std::size_t leaf) { return at<std::uint8_t>("leaf_verdict", leaf) == verdict; });
  }
  /// With digests of the current content.
  void sign() {
    for (const auto& [name, bytes] : arrays) record["sha256"][name] = sha256(bytes);
    for (const char* name : {"heading_rad", "region", "mode_heading_rad"}) {
      if (arrays.contains(name)) record["plan_sha256"][name] = record["sha256"][name];
    }
  }
  std::string file() const {
    nlohmann::json now = header;
    now["__metadata__"]["fairway"] = record.dump();
    std::string text = now.dump();
    while (text.size() % 8 != 0) text += ' ';  // arrays are aligned
    const std::uint64_t length = text.size();
    std::string all(8, '\0');
    std::memcpy(all.data(), &length, 8);
    all += text;
    std::map<std::size_t, std::string> in_order;
    for (const auto& [name, bytes] : arrays) in_order[places.at(name)] += bytes;
    for (const auto& [begin, bytes] : in_order) all += bytes;
    return all;
  }
};

}  // namespace fairway_check
