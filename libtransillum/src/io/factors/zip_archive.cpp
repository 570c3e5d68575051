// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// ZIP archives as NumPy writes and reads them (APPNOTE.TXT 6.3.3, sections 4.3.7, 4.3.12, 4.3.16),
// with zlib for the CRC and deflated members (decisions/0083-hashes-and-archives.md).
#include "io/factors/zip_archive.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <ostream>

#include "transillum/errors.h"

namespace transillum {
namespace {

constexpr std::uint32_t member_mark = 0x04034b50, directory_mark = 0x02014b50,
                        end_mark = 0x06054b50;
constexpr std::size_t member_head = 30, directory_entry = 46, end_size = 22;
constexpr std::uint32_t stored = 0, deflated = 8;
/// Deflate makes at most 1032 bytes of one.
constexpr std::uint64_t largest_ratio = 1032;
constexpr std::uint64_t largest_archive = std::numeric_limits<std::uint32_t>::max();

std::string little(std::uint64_t value, int bytes) {
  std::string text;
  for (int k = 0; k < bytes; ++k) {
    text += static_cast<char>((value >> (8 * k)) & 0xff);
  }
  return text;
}

std::uint32_t crc_of(std::uint32_t crc, std::string_view bytes) {
  constexpr std::size_t block = std::size_t{1} << 30;  // zlib counts in unsigned int
  for (std::size_t done = 0; done < bytes.size(); done += block) {
    const std::string_view part = bytes.substr(done, block);
    crc = static_cast<std::uint32_t>(
        ::crc32(crc, reinterpret_cast<const Bytef*>(part.data()), static_cast<uInt>(part.size())));
  }
  return crc;
}

/// Version, flags, method, time and date: 1 January 1980, so that equal contents give equal files.
std::string common_fields() {
  return little(20, 2) + little(0, 2) + little(stored, 2) + little(0, 2) + little(0x21, 2);
}

}  // namespace

void ZipWriter::write(std::string_view bytes) {
  out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  written_ += bytes.size();
}

void ZipWriter::add(const std::string& name, std::string_view head, std::string_view body) {
  const std::uint64_t size = head.size() + body.size();
  if (written_ + size + (1 << 16) > largest_archive) {
    throw InputError("the form factors exceed 4 GiB, the limit of .npz files here; write .mtx");
  }
  const Member member{name, crc_of(crc_of(0, head), body), static_cast<std::uint32_t>(size),
                      static_cast<std::uint32_t>(written_)};
  write(little(member_mark, 4) + common_fields() + little(member.crc, 4) + little(size, 4) +
        little(size, 4) + little(name.size(), 2) + little(0, 2) + name);
  write(head);
  write(body);
  members_.push_back(member);
}

void ZipWriter::finish() {
  const std::uint64_t begin = written_;
  for (const Member& member : members_) {
    write(little(directory_mark, 4) + little(20, 2) + common_fields() + little(member.crc, 4) +
          little(member.size, 4) + little(member.size, 4) + little(member.name.size(), 2) +
          little(0, 2) + little(0, 2) + little(0, 2) + little(0, 2) + little(0, 4) +
          little(member.offset, 4) + member.name);
  }
  const std::uint64_t size = written_ - begin;
  write(little(end_mark, 4) + little(0, 4) + little(members_.size(), 2) +
        little(members_.size(), 2) + little(size, 4) + little(begin, 4) + little(0, 2));
}

ZipReader::ZipReader(std::string name, std::string_view bytes)
    : name_(std::move(name)), bytes_(bytes) {
  const std::size_t end = end_record();
  const std::uint32_t count = number(end + 10, 2);
  std::size_t at = number(end + 16, 4);
  for (std::uint32_t k = 0; k < count; ++k) {
    if (number(at, 4) != directory_mark) {
      refuse("its directory is damaged");
    }
    const std::size_t length = number(at + 28, 2);
    const std::size_t after = at + directory_entry + length;
    if (after > bytes_.size()) {
      refuse("its directory is damaged");
    }
    if ((number(at + 8, 2) & 1) != 0) {
      refuse("it is encrypted");
    }
    const Member member{number(at + 10, 2), number(at + 16, 4), number(at + 20, 4),
                        number(at + 24, 4), number(at + 42, 4)};
    if (member.size == largest_archive || member.packed == largest_archive) {
      refuse("it has members of more than 4 GiB");
    }
    members_.emplace(bytes_.substr(at + directory_entry, length), member);
    at = after + number(at + 30, 2) + number(at + 32, 2);
  }
}

void ZipReader::refuse(const std::string& what) const {
  throw InputError(fmt::format("{}: not a .npz file that can be read: {}", name_, what));
}

/// A number of the archive, the lowest byte first.
std::uint32_t ZipReader::number(std::size_t at, std::size_t bytes) const {
  if (at > bytes_.size() || bytes > bytes_.size() - at) {
    refuse("it ends early");
  }
  std::uint32_t value = 0;
  for (std::size_t k = bytes; k-- > 0;) {
    value = value << 8 | static_cast<unsigned char>(bytes_[at + k]);
  }
  return value;
}

/// Where the end record is: before the archive's comment, of at most 65535 bytes.
std::size_t ZipReader::end_record() const {
  if (bytes_.size() >= end_size) {
    const std::size_t last = bytes_.size() - end_size;
    for (std::size_t back = 0; back <= std::min<std::size_t>(last, 0xffff); ++back) {
      if (number(last - back, 4) == end_mark && number(last - back + 20, 2) == back) {
        return last - back;
      }
    }
  }
  refuse("it is not a ZIP archive");
}

std::string ZipReader::read(const std::string& member) const {
  const auto found = members_.find(member);
  if (found == members_.end()) {
    refuse(fmt::format("it has no array `{}`", member));
  }
  const Member& m = found->second;
  const auto damaged = [&] { refuse(fmt::format("its member {} is damaged", member)); };
  if (number(m.offset, 4) != member_mark) {
    damaged();
  }
  const std::size_t begin =
      std::size_t{m.offset} + member_head + number(m.offset + 26, 2) + number(m.offset + 28, 2);
  if (begin > bytes_.size() || m.packed > bytes_.size() - begin) {
    damaged();
  }
  const std::string_view packed = bytes_.substr(begin, m.packed);
  std::string unpacked;
  if (m.method == stored && m.size == m.packed) {
    unpacked = packed;
  } else if (m.method == deflated && m.size <= largest_ratio * (packed.size() + 1)) {
    unpacked.resize(m.size);
    z_stream stream{};
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = reinterpret_cast<Bytef*>(unpacked.data());
    stream.avail_out = static_cast<uInt>(unpacked.size());
    if (::inflateInit2(&stream, -MAX_WBITS) != Z_OK) {
      damaged();
    }
    const int result = ::inflate(&stream, Z_FINISH);
    ::inflateEnd(&stream);
    if (result != Z_STREAM_END || stream.avail_out != 0) {
      damaged();
    }
  } else {
    damaged();
  }
  if (crc_of(0, unpacked) != m.crc) {
    damaged();
  }
  return unpacked;
}

}  // namespace transillum
