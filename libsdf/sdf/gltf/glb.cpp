#include "sdf/gltf/glb.h"

#include <bit>
#include <cstdint>

namespace sdf {
namespace {

static_assert(std::endian::native == std::endian::little,
              "glTF's numbers are little-endian, and written as they are");

constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr std::uint32_t kHeader = 12, kChunkHeader = 8;

void put(std::ostream& out, std::uint32_t value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

std::uint32_t padded(std::size_t size) { return static_cast<std::uint32_t>((size + 3) / 4 * 4); }

void putChunk(std::ostream& out, std::uint32_t kind, const char* bytes, std::size_t size, char filler) {
  put(out, padded(size));
  put(out, kind);
  out.write(bytes, static_cast<std::streamsize>(size));
  for (std::size_t i = size; i < padded(size); ++i) out.put(filler);
}

}  // namespace

void writeGlb(std::ostream& out, std::string_view json, const std::vector<unsigned char>& data) {
  const std::uint32_t binary = data.empty() ? 0 : kChunkHeader + padded(data.size());
  put(out, kMagic);
  put(out, kVersion);
  put(out, kHeader + kChunkHeader + padded(json.size()) + binary);
  putChunk(out, kJsonChunk, json.data(), json.size(), ' ');
  if (!data.empty())
    putChunk(out, kBinaryChunk, reinterpret_cast<const char*>(data.data()), data.size(), '\0');
}

}  // namespace sdf
