// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "transillum/cancellation.h"

namespace transillum {

/// A glTF 2.0 file and its buffers in memory, and its numbers, which are checked as they are read:
/// the parser checks neither that indices exist nor that data is inside of its buffer.
///
/// All functions throw InputError naming the file and the element.
class GltfFile {
 public:
  /// Reads a .gltf file and the buffers and images that it names, or a .glb file.
  /// @throws also Canceled
  GltfFile(const std::filesystem::path& path, const Cancellation& cancellation);

  const tinygltf::Model& model() const { return model_; }
  /// The file and those that were read for it.
  const std::vector<std::string>& files() const { return files_; }

  /// Number of entries of an accessor, at most `largest_count`.
  std::size_t count_of(int accessor, std::size_t largest_count) const;
  /// The entries of an accessor as doubles, `components` each; normalized integers as -1 to 1. An
  /// accessor with more components is cut to them.
  std::vector<double> numbers(int accessor, std::size_t components) const;
  /// The entries of an accessor of whole numbers.
  std::vector<std::uint32_t> indices(int accessor) const;
  /// Half a unit of the last binary digit of an accessor's numbers whose largest magnitude this is.
  double rounding_of(int accessor, double largest) const;
  /// The encoded bytes of an image; empty if they could not be read.
  std::span<const unsigned char> image_bytes(std::size_t image) const;

  [[noreturn]] void fail(const std::string& what) const;

 private:
  void load(std::string bytes);
  void parse(const std::string& bytes);
  /// The text of the file, or of the first chunk of a .glb file.
  std::string_view text_of(std::string_view bytes) const;
  void check_extensions(const std::vector<std::string>& required) const;
  const tinygltf::Accessor& accessor(int index) const;
  /// The bytes of a view from `offset`; at least `size`.
  std::span<const unsigned char> bytes_of(int view, std::size_t offset, std::size_t size) const;

  std::string name_;
  const Cancellation& cancellation_;
  std::vector<std::string> files_;
  tinygltf::Model model_;
  std::map<int, double> quantized_;  ///< half a unit of an accessor's numbers
};

}  // namespace transillum
