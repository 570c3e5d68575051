// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Pictures as 32-bit floating-point numbers: OpenEXR, and portable float maps (PFM: a header of
// three lines, then rows from the bottom, R, G, B for each pixel).
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "io/pictures/picture_writers.h"
#include "transillum/picture.h"

namespace transillum {
namespace {

/// Three numbers for each pixel, rows from the top.
std::vector<float> floats_of(const Picture& picture) {
  std::vector<float> numbers;
  numbers.reserve(3 * picture.radiance.size());
  for (const Rgb& radiance : picture.radiance) {
    for (const double channel : {radiance.r, radiance.g, radiance.b}) {
      numbers.push_back(static_cast<float>(channel));
    }
  }
  return numbers;
}

/// A file in memory: OpenEXR writes the table of its lines last, at its beginning, which a pipe
/// cannot take.
class MemoryFile : public Imf::OStream {
 public:
  MemoryFile() : Imf::OStream("picture") {}
  const std::string& bytes() const { return bytes_; }

  void write(const char data[], int size) override {
    const auto length = static_cast<std::size_t>(size);
    if (bytes_.size() < position_ + length) {
      bytes_.resize(position_ + length);
    }
    bytes_.replace(position_, length, data, length);
    position_ += length;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

 private:
  std::string bytes_;
  std::size_t position_ = 0;
};

}  // namespace

void write_picture_exr(std::ostream& out, const Picture& picture) {
  std::vector<float> numbers = floats_of(picture);
  const std::size_t pixel = 3 * sizeof(float);
  Imf::Header header(picture.width, picture.height);
  Imf::addComments(header, "R, G, B: radiance, W/(m2 sr), linear");
  Imf::FrameBuffer buffer;
  constexpr std::array names{"R", "G", "B"};
  for (std::size_t c = 0; c < names.size(); ++c) {
    header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
    buffer.insert(names[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(numbers.data() + c),
                                       pixel, pixel * static_cast<std::size_t>(picture.width)));
  }
  MemoryFile memory;
  {
    Imf::OutputFile file(memory, header, 0);
    file.setFrameBuffer(buffer);
    file.writePixels(picture.height);
  }
  out.write(memory.bytes().data(), static_cast<std::streamsize>(memory.bytes().size()));
}

void write_picture_pfm(std::ostream& out, const Picture& picture) {
  static_assert(std::endian::native == std::endian::little);  // a scale below 0 says so
  const std::vector<float> numbers = floats_of(picture);
  const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
  out << fmt::format("PF\n{} {}\n-1.0\n", picture.width, picture.height);
  for (std::size_t end = numbers.size(); end >= row; end -= row) {
    out.write(reinterpret_cast<const char*>(numbers.data() + end - row),
              static_cast<std::streamsize>(row * sizeof(float)));
  }
}

}  // namespace transillum
