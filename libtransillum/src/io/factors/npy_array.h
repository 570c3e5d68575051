// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace transillum {

/// The head of NumPy's .npy format, version 1, for an array of little-endian numbers or bytes.
/// @param type as NumPy writes it, such as `<f8`
/// @param shape as in Python, such as `(3,)`
std::string npy_head(const std::string& type, const std::string& shape);

/// An array in NumPy's .npy format, little-endian, of at most one dimension.
class NpyArray {
 public:
  /// Keeps `bytes`.
  /// @param name for error messages, such as `f.npz: data`
  /// @throws InputError
  NpyArray(std::string name, std::string bytes);

  /// Number of entries; 1 without a dimension.
  std::size_t size() const { return size_; }
  /// The entries of an array of doubles or floats.
  /// @throws InputError
  std::vector<double> numbers() const;
  /// The entries of an array of whole numbers with 32 or 64 bits.
  /// @throws InputError
  std::vector<std::int64_t> whole_numbers() const;
  /// The text of an array without a dimension.
  /// @throws InputError
  std::string text() const;

 private:
  [[noreturn]] void refuse(const std::string& what) const;
  void read_head(std::string_view head);
  template <class Stored, class Value>
  std::vector<Value> converted() const;

  std::string name_, bytes_;
  std::string type_;
  std::size_t begin_ = 0, size_ = 1, width_ = 0;
};

}  // namespace transillum
