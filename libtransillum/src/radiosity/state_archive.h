// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Writing the members of objects to a stream as they are in memory, and reading them back bit for
// bit. A class has one function for both,
//
//   template <class Archive, class Self>
//   static void visit_state(Archive& archive, Self& self) { archive(self.a_, self.b_); }
//
// which a StateOutput calls with a constant object and a StateInput with one to be changed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "transillum/transfers.h"
#include "transillum/vec3.h"

namespace transillum {

/// A state that no program has written: cut off, changed, or of another object.
class DamagedState : public std::runtime_error {
 public:
  DamagedState() : std::runtime_error("its content is damaged") {}
};

/// Whether lists of T are stored as a block of memory: T must have no padding, and all bit patterns
/// must be values.
template <class T>
inline constexpr bool stored_as_bytes = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;
template <>
inline constexpr bool stored_as_bytes<Rgb> = true;
template <>
inline constexpr bool stored_as_bytes<Vec3> = true;
template <>
inline constexpr bool stored_as_bytes<Transfer> = true;
template <>
inline constexpr bool stored_as_bytes<TransferMoments> = true;
template <>
inline constexpr bool stored_as_bytes<CoverageMoments> = true;

/// Writes states. Errors of the stream are left to its owner.
class StateOutput {
 public:
  static constexpr bool reading = false;

  explicit StateOutput(std::ostream& out) : out_(out) {}

  template <class... Values>
  void operator()(const Values&... values) {
    (put(values), ...);
  }
  /// Lists whose lengths StateInput compares with those that they have.
  template <class... Lists>
  void fixed(const Lists&... lists) {
    (put(lists), ...);
  }
  /// Lists that are empty or have `size` entries.
  template <class... Lists>
  void empty_or(std::size_t /*size*/, const Lists&... lists) {
    (put(lists), ...);
  }
  /// Bytes of a list of which the length is written before.
  void block(const void* bytes, std::size_t size) {
    out_.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  }
  /// Does nothing; StateInput checks the condition on what it has read.
  void require(bool /*condition*/) const {}

 private:
  template <class T>
  void put(const T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      put(static_cast<std::uint8_t>(value));
    } else if constexpr (stored_as_bytes<T>) {
      out_.write(reinterpret_cast<const char*>(&value), sizeof value);
    } else {
      T::visit_state(*this, value);
    }
  }
  template <class T>
  void put(const std::vector<T>& list) {
    put(static_cast<std::uint64_t>(list.size()));
    if constexpr (stored_as_bytes<T>) {
      out_.write(reinterpret_cast<const char*>(list.data()),
                 static_cast<std::streamsize>(list.size() * sizeof(T)));
    } else {
      for (const T& value : list) {
        put(value);
      }
    }
  }
  template <class T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) {
      put(*value);
    }
  }

  std::ostream& out_;
};

/// Reads states that a StateOutput of the same program has written. Takes no more memory than the
/// state is long.
/// @throws DamagedState
class StateInput {
 public:
  static constexpr bool reading = true;

  /// @param size bytes of the state
  StateInput(std::istream& in, std::uint64_t size) : in_(in), left_(size) {}

  template <class... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }
  template <class... Lists>
  void fixed(Lists&... lists) {
    (get_sized(lists, lists.size()), ...);
  }
  template <class... Lists>
  void empty_or(std::size_t size, Lists&... lists) {
    const auto get_one = [&](auto& list) {
      get(list);
      require(list.empty() || list.size() == size);
    };
    (get_one(lists), ...);
  }
  void block(void* bytes, std::size_t size) { read(bytes, size); }
  /// Bytes of the state that are not read yet.
  std::uint64_t left() const { return left_; }
  void require(bool condition) const {
    if (!condition) {
      throw DamagedState();
    }
  }
  /// Requires that nothing is left.
  void finish() const { require(left_ == 0); }

 private:
  void read(void* to, std::uint64_t size) {
    require(size <= left_);
    left_ -= size;
    in_.read(static_cast<char*>(to), static_cast<std::streamsize>(size));
    require(static_cast<bool>(in_));
  }
  template <class T>
  void get(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = 0;
      get(byte);
      require(byte < 2);
      value = byte == 1;
    } else if constexpr (stored_as_bytes<T>) {
      read(&value, sizeof value);
    } else {
      T::visit_state(*this, value);
    }
  }
  template <class T>
  void get(std::vector<T>& list) {
    std::uint64_t size = 0;
    get(size);
    // An entry that is no block of memory takes at least one byte.
    require(size <= left_ / (stored_as_bytes<T> ? sizeof(T) : 1));
    list.resize(static_cast<std::size_t>(size));
    if constexpr (stored_as_bytes<T>) {
      read(list.data(), size * sizeof(T));
    } else {
      for (T& value : list) {
        get(value);
      }
    }
  }
  template <class List>
  void get_sized(List& list, std::size_t size) {
    get(list);
    require(list.size() == size);
  }
  template <class T>
  void get(std::optional<T>& value) {
    bool set = false;
    get(set);
    value.reset();
    if (set) {
      get(value.emplace());
    }
  }

  std::istream& in_;
  std::uint64_t left_;
};

}  // namespace transillum
