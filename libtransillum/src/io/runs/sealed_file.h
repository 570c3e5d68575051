// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Files in which runs are kept: a line with kind and format, a line of JSON (the head), bytes, and
// the CRC-32 of all this as eight hexadecimal digits. Numbers are as in memory; the head tells
// whether that is the same on this machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

#include "transillum/cancellation.h"

namespace transillum {

/// Writes a sealed file, complete or not at all.
/// @param kind such as "checkpoint"
/// @param write writes the bytes
/// @throws std::runtime_error if the file cannot be written, and what `write` throws
void write_sealed(const std::filesystem::path& file, const std::string& kind,
                  const nlohmann::ordered_json& head,
                  const std::function<void(std::ostream&)>& write);

/// A sealed file that is being read.
class SealedFile {
 public:
  /// Reads the head.
  /// @throws InputError where it is no file of this kind, or of another format or machine
  SealedFile(std::filesystem::path file, const std::string& kind);

  const std::filesystem::path& path() const { return path_; }
  const nlohmann::ordered_json& head() const { return head_; }
  /// Number of bytes between head and CRC.
  std::uint64_t size() const { return size_; }
  /// Reads all of it and compares the CRC. The next byte read is then the first after the head.
  /// @throws InputError where it is damaged or cut off; Canceled
  void check(const Cancellation& cancellation = {});
  std::istream& in() { return in_; }
  /// Goes to a byte, counted from the first after the head.
  void seek(std::uint64_t position);
  /// @throws InputError with the file's name and `reason`
  [[noreturn]] void refuse(const std::string& reason) const;

 private:
  std::filesystem::path path_;
  std::ifstream in_;
  nlohmann::ordered_json head_;
  std::uint64_t begin_ = 0, size_ = 0;
};

}  // namespace transillum
