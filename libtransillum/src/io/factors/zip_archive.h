// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace transillum {

/// Writes a ZIP archive whose members are stored without compression; none may exceed 4 GiB, nor
/// their sum.
class ZipWriter {
 public:
  explicit ZipWriter(std::ostream& out) : out_(out) {}
  /// Appends a member that consists of both parts.
  void add(const std::string& name, std::string_view head, std::string_view body);
  /// Writes the directory; to be called last.
  void finish();

 private:
  struct Member {
    std::string name;
    std::uint32_t crc, size, offset;
  };
  void write(std::string_view bytes);

  std::ostream& out_;
  std::uint64_t written_ = 0;
  std::vector<Member> members_;
};

/// The members of a ZIP archive in memory, found by its central directory: stored or deflated,
/// without encryption. Nothing that the archive states is trusted before it is checked.
class ZipReader {
 public:
  /// Keeps a reference to `bytes`.
  /// @param name of the file, for error messages
  /// @throws InputError
  ZipReader(std::string name, std::string_view bytes);

  bool has(const std::string& member) const { return members_.contains(member); }
  /// The bytes of a member, checked against its CRC.
  /// @throws InputError, also where there is none of this name
  std::string read(const std::string& member) const;

 private:
  struct Member {
    std::uint32_t method, crc, packed, size, offset;
  };
  [[noreturn]] void refuse(const std::string& what) const;
  std::uint32_t number(std::size_t at, std::size_t bytes) const;
  std::size_t end_record() const;

  std::string name_;
  std::string_view bytes_;
  std::map<std::string, Member> members_;
};

}  // namespace transillum
