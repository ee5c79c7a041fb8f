// A list for each section, all in one array: a list is a block of the array that grows into one of
// twice the size; its old block is reused by other lists.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fairway/base/error.hpp"

namespace fairway {

template <typename T>
class SectionLists {
 public:
  explicit SectionLists(std::size_t sections) : list_(sections) {}

  std::size_t size() const { return list_.size(); }
  std::span<const T> operator[](std::size_t section) const {
    return {slot_.data() + list_[section].first, list_[section].count};
  }
  void add(std::size_t section, const T& value) { insert(section, list_[section].count, value); }
  void insert(std::size_t section, std::size_t at, const T& value) {
    List& list = list_[section];
    if (list.count == capacity(list)) grow(list);
    T* const block = slot_.data() + list.first;
    for (std::size_t i = list.count; i > at; --i) block[i] = block[i - 1];
    block[at] = value;
    ++list.count;
  }
  /// The last entry replaces the one removed.
  void remove(std::size_t section, std::size_t at) {
    List& list = list_[section];
    T* const block = slot_.data() + list.first;
    block[at] = block[--list.count];
  }
  void clear(std::size_t section) { list_[section].count = 0; }

  std::size_t bytes() const {
    std::size_t total = list_.capacity() * sizeof(List) + slot_.capacity() * sizeof(T);
    for (const auto& unused : free_) total += unused.capacity() * sizeof(std::uint32_t);
    return total;
  }

 private:
  static constexpr std::uint8_t no_block = 0xff;
  struct List {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint8_t power = no_block;  // it has room for 2^power
  };
  static std::uint32_t capacity(const List& list) {
    return list.power == no_block ? 0U : std::uint32_t{1} << list.power;
  }
  void grow(List& list) {
    const auto power = static_cast<std::uint8_t>(list.power == no_block ? 1 : list.power + 1);
    if (free_.size() <= power) free_.resize(power + std::size_t{1});
    std::uint32_t first = static_cast<std::uint32_t>(slot_.size());
    if (free_[power].empty()) {
      require(slot_.size() + (std::size_t{1} << power) <= ~std::uint32_t{0},
              "the lists together hold fewer than 2^32 entries");
      slot_.resize(slot_.size() + (std::size_t{1} << power));
    } else {
      first = free_[power].back();
      free_[power].pop_back();
    }
    for (std::uint32_t i = 0; i < list.count; ++i) slot_[first + i] = slot_[list.first + i];
    if (list.power != no_block) free_[list.power].push_back(list.first);
    list.first = first;
    list.power = power;
  }

  std::vector<List> list_;
  std::vector<T> slot_;
  std::vector<std::vector<std::uint32_t>> free_;  // [power] free blocks
};

}  // namespace fairway
