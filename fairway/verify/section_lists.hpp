// A list for each section: a block of its own that grows by a quarter, and shrinks again. The lists
// of neighbours grow and shrink at different times, so that an allocator that joins free blocks
// keeps them with less room than blocks of fixed sizes in one array.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "fairway/base/error.hpp"

namespace fairway {

template <typename T>
class SectionLists {
 public:
  static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= alignof(std::uint64_t));

  explicit SectionLists(std::size_t sections) : list_(sections, nullptr) {}
  SectionLists(SectionLists&& other) noexcept
      : list_(std::exchange(other.list_, {})), bytes_(std::exchange(other.bytes_, 0)) {}
  SectionLists& operator=(SectionLists&& other) noexcept {
    std::swap(list_, other.list_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~SectionLists() {
    for (Block* const block : list_) std::free(block);
  }

  std::size_t size() const { return list_.size(); }
  std::span<const T> operator[](std::size_t section) const {
    const Block* const block = list_[section];
    return block == nullptr ? std::span<const T>{} : std::span(entries(block), block->count);
  }
  std::span<T> operator[](std::size_t section) {
    Block* const block = list_[section];
    return block == nullptr ? std::span<T>{} : std::span(entries(block), block->count);
  }
  /// For a list that begins, with room for `count` entries and no more.
  void make_room(std::size_t section, std::size_t count) {
    if (count > 0) resize(section, count);
  }
  void add(std::size_t section, const T& value) { insert(section, (*this)[section].size(), value); }
  void insert(std::size_t section, std::size_t at, const T& value) {
    Block* block = list_[section];
    if (block == nullptr || block->count == block->room) block = resize(section, grown(block));
    T* const entry = entries(block);
    for (std::size_t i = block->count; i > at; --i) entry[i] = entry[i - 1];
    entry[at] = value;
    ++block->count;
  }
  /// The last entry replaces the one removed.
  void remove(std::size_t section, std::size_t at) {
    Block* const block = list_[section];
    T* const entry = entries(block);
    entry[at] = entry[--block->count];
    if (block->count == 0 || block->count + least_waste < block->room / 2) {
      resize(section, block->count);
    }
  }
  void clear(std::size_t section) {
    if (list_[section] == nullptr) return;
    list_[section]->count = 0;
    resize(section, 0);
  }

  std::size_t bytes() const { return list_.capacity() * sizeof(void*) + bytes_; }

 private:
  static constexpr std::uint32_t least_waste = 4;
  struct Block {
    std::uint32_t count;
    std::uint32_t room;
  };
  static_assert(sizeof(Block) % alignof(T) == 0);

  static const T* entries(const Block* block) { return reinterpret_cast<const T*>(block + 1); }
  static T* entries(Block* block) { return reinterpret_cast<T*>(block + 1); }
  static std::size_t bytes_of(std::size_t room) {  // with the allocator's own
    return (sizeof(Block) + room * sizeof(T) + sizeof(std::size_t) + 15) / 16 * 16;
  }
  /// More room than a block has, and as much as the allocator gives anyway.
  static std::size_t grown(const Block* block) {
    const std::size_t count = block == nullptr ? 0 : block->count;
    const std::size_t least = count + 1 + count / 4;
    return (bytes_of(least) - sizeof(std::size_t) - sizeof(Block)) / sizeof(T);
  }
  Block* resize(std::size_t section, std::size_t room) {
    Block*& block = list_[section];
    require(room < ~std::uint32_t{0}, "a list has fewer than 2^32 entries");
    bytes_ -= block == nullptr ? 0 : bytes_of(block->room);
    if (room == 0) {
      std::free(std::exchange(block, nullptr));
      return nullptr;
    }
    auto* const moved = static_cast<Block*>(std::realloc(block, sizeof(Block) + room * sizeof(T)));
    if (moved == nullptr) throw std::bad_alloc();
    if (block == nullptr) moved->count = 0;
    block = moved;
    block->room = static_cast<std::uint32_t>(room);
    bytes_ += bytes_of(room);
    return block;
  }

  std::vector<Block*> list_;
  std::size_t bytes_ = 0;
};

}  // namespace fairway
