// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/world/state_values.h>

#include <bit>
#include <string>
#include <type_traits>

namespace pitchboard::sim {
namespace {

/// FNV-1a, 64 bits, over eight bytes a value (offset basis and prime: draft-eastlake-fnv).
class Hasher {
 public:
  void value(const std::string& text) {
    add(text.size());
    for (const char c : text) add(extended(static_cast<int>(c)));
  }
  template <class T>
  void value(const T& value) {
    if constexpr (std::is_same_v<T, double>) {
      add(std::bit_cast<std::uint64_t>(value));
    } else if constexpr (std::is_enum_v<T>) {
      add(extended(static_cast<int>(value)));
    } else if constexpr (std::is_same_v<T, int>) {
      add(extended(value));
    } else {
      add(std::uint64_t{value});
    }
  }
  template <class T>
  void count(const std::vector<T>& list) {
    add(list.size());
  }
  // Both follow from what was hashed before.
  template <class T>
  void sameCount(const std::vector<T>& /*list*/, std::size_t /*size*/) {}
  template <class Physics>
  void alternative(const Physics& /*physics*/) {}

  /// Nothing is added where nothing is, so that matches without a referee keep their hashes.
  template <class T>
  bool present(const std::optional<T>& value) {
    return value.has_value();
  }

  std::uint64_t hash() const { return m_hash; }

 private:
  static std::uint64_t extended(int value) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
  }
  void add(std::uint64_t value) {
    for (int byte = 0; byte < 8; ++byte) {
      m_hash = (m_hash ^ (value & 0xff)) * 0x100000001b3ULL;
      value >>= 8;
    }
  }
  std::uint64_t m_hash = 0xcbf29ce484222325ULL;
};

}  // namespace

std::uint64_t stateHash(const WorldState& world) {
  Hasher hasher;
  visitValues(world, hasher);
  return hasher.hash();
}

}  // namespace pitchboard::sim
