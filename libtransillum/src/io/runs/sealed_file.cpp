// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/runs/sealed_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <ostream>
#include <streambuf>
#include <system_error>
#include <utility>
#include <vector>

#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum {
namespace {

using Json = nlohmann::ordered_json;

constexpr int format = 1;
constexpr std::size_t seal_size = 8;
constexpr std::size_t longest_head = std::size_t{1} << 24;

const char* byte_order() {
  return std::endian::native == std::endian::little ? "little-endian" : "big-endian";
}

std::string first_line(const std::string& kind) {
  return fmt::format("transillum {} {}", kind, format);
}

/// Passes what is written on to another stream, and computes its CRC.
class CheckedOutput : public std::streambuf {
 public:
  explicit CheckedOutput(std::ostream& out) : out_(out) {
    setp(buffer_.data(), buffer_.data() + buffer_.size());
  }

  std::uint32_t crc() {
    sync();
    return crc_;
  }

 protected:
  int_type overflow(int_type c) override {
    sync();
    return traits_type::eq_int_type(c, traits_type::eof()) ? traits_type::not_eof(c)
                                                           : sputc(traits_type::to_char_type(c));
  }
  std::streamsize xsputn(const char* bytes, std::streamsize size) override {
    if (size < epptr() - pptr()) {
      std::copy_n(bytes, size, pptr());
      pbump(static_cast<int>(size));
    } else {
      sync();
      put(bytes, size);
    }
    return out_ ? size : 0;
  }
  int sync() override {
    put(pbase(), pptr() - pbase());
    setp(buffer_.data(), buffer_.data() + buffer_.size());
    return out_ ? 0 : -1;
  }

 private:
  void put(const char* bytes, std::streamsize size) {
    constexpr std::streamsize most = 1 << 30;  // zlib counts in unsigned int
    for (std::streamsize done = 0; done < size; done += most) {
      const std::streamsize block = std::min(most, size - done);
      crc_ = static_cast<std::uint32_t>(
          ::crc32(crc_, reinterpret_cast<const Bytef*>(bytes + done), static_cast<uInt>(block)));
      out_.write(bytes + done, block);
    }
  }

  std::ostream& out_;
  std::uint32_t crc_ = 0;
  std::array<char, 1 << 16> buffer_{};
};

}  // namespace

void write_sealed(const std::filesystem::path& file, const std::string& kind, const Json& head,
                  const std::function<void(std::ostream&)>& write) {
  write_file_whole(file, [&](std::ostream& to) {
    CheckedOutput buffer(to);
    std::ostream out(&buffer);
    Json full = head;
    full["byte_order"] = byte_order();
    out << first_line(kind) << '\n'
        << full.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n';
    write(out);
    out.flush();
    to << fmt::format("{:08x}", buffer.crc());
    if (!out) {
      to.setstate(std::ios::badbit);
    }
  });
}

SealedFile::SealedFile(std::filesystem::path file, const std::string& kind)
    : path_(std::move(file)) {
  std::error_code error;
  if (!std::filesystem::exists(path_, error)) {
    refuse("there is no such file");
  }
  if (!std::filesystem::is_regular_file(path_, error)) {  // opening a pipe would block
    refuse("it is not a regular file");
  }
  const std::uint64_t total = std::filesystem::file_size(path_, error);
  in_.open(path_, std::ios::binary);
  if (error || !in_) {
    refuse("it cannot be read");
  }
  const std::string expected = first_line(kind);
  std::string line(expected.size(), '\0');
  in_.read(line.data(), static_cast<std::streamsize>(line.size()));
  if (!in_ || line.rfind(fmt::format("transillum {} ", kind), 0) != 0) {
    refuse(fmt::format("it is not a {} of transillum", kind));
  }
  if (line != expected || in_.get() != '\n') {
    refuse(fmt::format("it is a {} of another version of transillum", kind));
  }
  std::string text;
  for (int c = in_.get(); c != '\n'; c = in_.get()) {
    if (c == std::char_traits<char>::eof() || text.size() == longest_head) {
      refuse("it is cut off");
    }
    text += static_cast<char>(c);
  }
  head_ = Json::parse(text, nullptr, false);
  if (!head_.is_object()) {
    refuse("its head is damaged");
  }
  if (head_.value("byte_order", Json()) != Json(byte_order())) {
    refuse("it was written by a machine that stores numbers in another order");
  }
  begin_ = static_cast<std::uint64_t>(in_.tellg());
  if (total < begin_ + seal_size) {
    refuse("it is cut off");
  }
  size_ = total - begin_ - seal_size;
}

void SealedFile::check(const Cancellation& cancellation) {
  in_.clear();
  in_.seekg(0);
  std::vector<char> block(std::size_t{1} << 20);
  auto crc = static_cast<uLong>(0);
  for (std::uint64_t left = begin_ + size_; left > 0;) {
    cancellation.throw_if_canceled();
    const auto part = std::min<std::uint64_t>(left, block.size());
    in_.read(block.data(), static_cast<std::streamsize>(part));
    if (!in_) {
      refuse("it cannot be read");
    }
    crc = ::crc32(crc, reinterpret_cast<const Bytef*>(block.data()), static_cast<uInt>(part));
    left -= part;
  }
  std::string seal(seal_size, '\0');
  in_.read(seal.data(), static_cast<std::streamsize>(seal.size()));
  if (!in_ || seal != fmt::format("{:08x}", crc)) {
    refuse("it is damaged or cut off");
  }
  seek(0);
}

void SealedFile::seek(std::uint64_t position) {
  in_.clear();
  in_.seekg(static_cast<std::streamoff>(begin_ + position));
}

void SealedFile::refuse(const std::string& reason) const {
  throw InputError(fmt::format("{}: {}", path_.string(), reason));
}

}  // namespace transillum
