#include "image/exr.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "image/rgb.h"

// The only file that knows OpenEXR. Its exceptions end here.
namespace radfarm {
namespace {

constexpr int kThreads = 0;  // OpenEXR's own pool stays unused: callers encode on the thread they have

class MemoryOutput : public Imf::OStream {
 public:
  MemoryOutput() : Imf::OStream("memory") {}
  void write(const char c[], int n) override {
    const auto count = static_cast<std::size_t>(n);
    if (bytes_.size() < position_ + count) bytes_.resize(position_ + count);
    std::memcpy(bytes_.data() + position_, c, count);
    position_ += count;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
  std::size_t position_ = 0;
};

class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(std::span<const std::byte> bytes) : Imf::IStream("memory"), bytes_(bytes) {}
  bool read(char c[], int n) override {
    const auto count = static_cast<std::size_t>(n);
    if (n < 0 || position_ > bytes_.size() || count > bytes_.size() - position_) {
      throw std::runtime_error("unexpected end of file");
    }
    std::memcpy(c, bytes_.data() + position_, count);
    position_ += count;
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  std::span<const std::byte> bytes_;
  std::size_t position_ = 0;
};

tl::unexpected<Error> damaged(std::string_view what) {
  return fail(Code::kDataLoss, "not a readable OpenEXR file: " + std::string(what));
}

/// Reads fields off the front of the header; nothing when the bytes end first.
class HeaderCursor {
 public:
  explicit HeaderCursor(std::span<const std::byte> bytes) : rest_(bytes) {}
  std::optional<std::uint32_t> number() {
    if (rest_.size() < 4) return std::nullopt;
    std::uint32_t value = 0;
    std::memcpy(&value, rest_.data(), 4);
    rest_ = rest_.subspan(4);
    return value;
  }
  std::optional<std::string_view> text() {
    const auto end = std::find(rest_.begin(), rest_.end(), std::byte{0});
    if (end == rest_.end()) return std::nullopt;
    const auto size = static_cast<std::size_t>(end - rest_.begin());
    const std::string_view value(reinterpret_cast<const char*>(rest_.data()), size);
    rest_ = rest_.subspan(size + 1);
    return value;
  }
  bool skip(std::size_t count) {
    if (count > rest_.size()) return false;
    rest_ = rest_.subspan(count);
    return true;
  }

 private:
  std::span<const std::byte> rest_;
};

/// Walks the attributes before OpenEXR does, since it allocates an attribute's claimed size before it reads it.
Status check_header_sizes(std::span<const std::byte> bytes) {
  constexpr std::uint32_t kMagic = 20000630;
  constexpr std::uint32_t kDeepFlag = 0x800;
  constexpr std::uint32_t kMultiPartFlag = 0x1000;
  HeaderCursor cursor(bytes);
  if (cursor.number() != kMagic) return damaged("wrong magic number");
  const std::optional<std::uint32_t> version = cursor.number();
  if (!version || (*version & 0xff) != 2) return damaged("its version is not 2");
  if ((*version & (kDeepFlag | kMultiPartFlag)) != 0) {
    return fail(Code::kUnimplemented, "deep and multi-part OpenEXR files are not supported");
  }
  for (;;) {
    const std::optional<std::string_view> name = cursor.text();
    if (!name) return damaged("its header is cut off");
    if (name->empty()) return {};
    const std::optional<std::string_view> type = cursor.text();
    const std::optional<std::uint32_t> size = cursor.number();
    if (!type || !size || !cursor.skip(*size)) return damaged("attribute '" + std::string(*name) + "' is cut off");
  }
}

std::size_t channel_count(const Imf::ChannelList& channels) {
  std::size_t count = 0;
  for (auto it = channels.begin(); it != channels.end(); ++it) ++count;
  return count;
}

/// An image without pixels yet, of the header's size, when that is acceptable.
Result<Image> checked_size(const Imf::Header& header, std::size_t file_size) {
  constexpr std::size_t kLargestCompression = 4096;  // ZIP reaches 1030:1, PIZ more on constant images
  const Imath::Box2i& window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1) return damaged("its data window is empty");
  if (width > kMaxImageSide || height > kMaxImageSide) {
    return fail(Code::kResourceExhausted, "OpenEXR image is " + std::to_string(width) + "x" + std::to_string(height) +
                                              " pixels; the limit is " + std::to_string(kMaxImageSide) + " a side");
  }
  Image image;
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  const std::size_t channels = channel_count(header.channels());
  if (channels == 0) return damaged("it has no channels");
  if (channels > kMaxImageChannels || image.pixel_count() * 4 * channels > kMaxImageBytes) {
    return fail(Code::kResourceExhausted, "OpenEXR image with " + std::to_string(channels) + " channels is over the limit of " +
                                              std::to_string(kMaxImageBytes) + " bytes");
  }
  if (image.pixel_count() * channels / kLargestCompression > file_size) return damaged("its pixels are missing");
  return image;
}

Result<Image> read_pixels(Imf::InputFile& file, std::size_t file_size) {
  const Imf::Header& header = file.header();
  RADFARM_TRY(Image image, checked_size(header, file_size));
  Imf::FrameBuffer frame;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    if (it.channel().xSampling != 1 || it.channel().ySampling != 1) {
      return fail(Code::kUnimplemented, std::string("OpenEXR channel '") + it.name() + "' is subsampled");
    }
    std::vector<float>& values = image.channels[it.name()];
    values.resize(image.pixel_count());
    frame.insert(it.name(), Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow()));
  }
  file.setFrameBuffer(frame);
  file.readPixels(header.dataWindow().min.y, header.dataWindow().max.y);
  for (auto it = header.begin(); it != header.end(); ++it) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute());
    if (text != nullptr) image.attributes[it.name()] = text->value();
  }
  return image;
}

}  // namespace

Result<std::vector<std::byte>> encode_exr(const Image& image) {
  RADFARM_TRY_STATUS(validate(image));
  if (image.width > kMaxImageSide || image.height > kMaxImageSide || image.channels.empty()) {
    return fail(Code::kInvalidArgument, "an OpenEXR image needs a channel and at most " + std::to_string(kMaxImageSide) +
                                            " pixels a side");
  }
  try {
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addChromaticities(header, Imf::Chromaticities());  // the default is Rec.709 with D65
    for (const auto& [name, text] : image.attributes) header.insert(name, Imf::StringAttribute(text));
    Imf::FrameBuffer frame;
    for (const auto& [name, values] : image.channels) {
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
      frame.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow()));
    }
    MemoryOutput output;
    {
      Imf::OutputFile file(output, header, kThreads);
      file.setFrameBuffer(frame);
      file.writePixels(image.height);
    }  // writes the line table
    return output.take();
  } catch (const std::exception& error) {
    return fail(Code::kInvalidArgument, std::string("cannot encode OpenEXR: ") + error.what());
  }
}

Result<Image> decode_exr(std::span<const std::byte> bytes) {
  RADFARM_TRY_STATUS(check_header_sizes(bytes));
  try {
    // Process-wide in OpenEXR, and the same at every call.
    Imf::Header::setMaxImageSize(kMaxImageSide, kMaxImageSide);
    Imf::Header::setMaxTileSize(kMaxImageSide, kMaxImageSide);
    MemoryInput input(bytes);
    Imf::InputFile file(input, kThreads);
    return read_pixels(file, bytes.size());
  } catch (const std::exception& error) {
    return damaged(error.what());
  }
}

}  // namespace radfarm
