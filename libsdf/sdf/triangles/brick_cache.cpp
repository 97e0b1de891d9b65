#include "sdf/triangles/brick_cache.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sdf/base/file.h"

namespace sdf {
namespace {

namespace fs = std::filesystem;

// What a file begins with; to be changed with what samples are, or how they are written.
constexpr std::string_view kFormat = "libsdf bricks 1\n";
constexpr const char* kExtension = ".bricks";

/// FNV-1a, by Fowler, Noll and Vo (1991), of words instead of bytes.
class Hash {
 public:
  void add(const void* data, std::size_t bytes) {
    const char* from = static_cast<const char*>(data);
    for (; bytes >= sizeof(std::uint64_t); bytes -= sizeof(std::uint64_t), from += sizeof(std::uint64_t)) {
      std::uint64_t word;
      std::memcpy(&word, from, sizeof word);
      add(word);
    }
    std::uint64_t rest = bytes;
    std::memcpy(&rest, from, bytes);
    add(rest);
  }
  std::uint64_t value() const { return value_; }

 private:
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x100000001b3u;
    value_ ^= value_ >> 32;  // bits of a word's upper half would never come down
  }
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// Numbers one after the other, as they lie in memory.
class Bytes {
 public:
  explicit Bytes(std::string bytes = {}) : bytes_(std::move(bytes)) {}
  template <typename T>
  void put(const T* from, std::size_t count) {
    bytes_.append(reinterpret_cast<const char*>(from), count * sizeof(T));
  }
  template <typename T>
  bool take(T* to, std::size_t count) {
    if (count > (bytes_.size() - at_) / sizeof(T)) return false;
    std::memcpy(to, bytes_.data() + at_, count * sizeof(T));
    at_ += count * sizeof(T);
    return true;
  }
  bool ended() const { return at_ == bytes_.size(); }
  const std::string& all() const { return bytes_; }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

std::uint64_t hashOf(std::string_view bytes) {
  Hash hash;
  hash.add(bytes.data(), bytes.size());
  return hash.value();
}

// All but the names and kinds of the volumes, which bricksOf alone gives.
std::string written(const Bricks& b) {
  Bytes out;
  out.put(&b.voxel, 1);
  out.put(&b.origin, 1);
  out.put(&b.cells, 1);
  out.put(&b.columns, 1);
  out.put(&b.count, 1);
  out.put(&b.worst, 1);
  out.put(&b.rms, 1);
  for (const PayloadVolume& volume : b.volumes) {
    const std::uint64_t count = volume.values.size();
    out.put(&volume.size, 1);
    out.put(&count, 1);
    out.put(volume.values.data(), count);
  }
  return out.all();
}

bool readInto(std::string bytes, Bricks& b) {
  Bytes in(std::move(bytes));
  if (!in.take(&b.voxel, 1) || !in.take(&b.origin, 1) || !in.take(&b.cells, 1) || !in.take(&b.columns, 1) ||
      !in.take(&b.count, 1) || !in.take(&b.worst, 1) || !in.take(&b.rms, 1))
    return false;
  for (PayloadVolume& volume : b.volumes) {
    std::uint64_t count = 0;
    if (!in.take(&volume.size, 1) || !in.take(&count, 1)) return false;
    if (count > in.all().size()) return false;
    volume.values.resize(count);
    if (!in.take(volume.values.data(), count)) return false;
  }
  return in.ended();
}

// The bytes behind the format and their hash, if they are what that says.
std::optional<std::string> contentOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string format(kFormat.size(), '\0');
  std::uint64_t hash = 0;
  if (!in.read(format.data(), std::ssize(format)) || format != kFormat) return {};
  if (!in.read(reinterpret_cast<char*>(&hash), sizeof hash)) return {};
  const auto begin = in.tellg();
  std::string bytes(static_cast<std::size_t>(in.seekg(0, std::ios::end).tellg() - begin), '\0');
  if (!in.seekg(begin).read(bytes.data(), std::ssize(bytes))) return {};
  return hashOf(bytes) == hash ? std::optional(std::move(bytes)) : std::nullopt;
}

}  // namespace

fs::path BrickCache::usersFolder() {
  for (const auto& [name, below] :
       {std::pair{"XDG_CACHE_HOME", "libsdf"}, std::pair{"HOME", ".cache/libsdf"}})
    if (const char* const folder = std::getenv(name); folder && fs::path(folder).is_absolute())
      return fs::path(folder) / below;
  return {};
}

fs::path BrickCache::fileOf(const TriangleDistance& distance, int voxels) const {
  const auto& points = distance.triangles().points;
  const auto& triangles = distance.triangles().triangles;
  Hash hash;
  hash.add(points.data(), points.size() * sizeof points[0]);
  hash.add(triangles.data(), triangles.size() * sizeof triangles[0]);
  char name[64];
  std::snprintf(name, sizeof name, "%016llx-%zu-%d", static_cast<unsigned long long>(hash.value()),
                triangles.size(), voxels);
  return folder_ / (std::string(name) + kExtension);
}

Bricks BrickCache::bricks(const TriangleDistance& distance, int voxels) const {
  const fs::path file = fileOf(distance, voxels);
  std::error_code ignored;
  if (auto bytes = contentOf(file)) {
    Bricks kept;
    if (readInto(std::move(*bytes), kept)) {
      fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
      return kept;
    }
  }
  Bricks taken = bricksOf(distance, voxels);
  fs::create_directories(folder_, ignored);
  const std::string bytes = written(taken);
  const std::uint64_t hash = hashOf(bytes);
  // Where that cannot be they are taken again the next time.
  if (writeFile(file, [&](std::ostream& out) {
        out << kFormat;
        out.write(reinterpret_cast<const char*>(&hash), sizeof hash);
        out << bytes;
        return okStatus();
      }))
    makeRoom();
  return taken;
}

void BrickCache::makeRoom() const {
  struct Kept {
    fs::file_time_type used;
    std::uintmax_t bytes;
    fs::path file;
  };
  std::error_code ignored;
  std::vector<Kept> all;
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(folder_, ignored))
    if (entry.path().extension() == kExtension) {
      const std::uintmax_t size = entry.file_size(ignored);
      if (ignored) continue;
      all.push_back({entry.last_write_time(ignored), size, entry.path()});
      bytes += size;
    }
  std::ranges::sort(all, {}, &Kept::used);
  for (const Kept& kept : all) {
    if (bytes <= kMost) break;
    fs::remove(kept.file, ignored);
    bytes -= kept.bytes;
  }
}

}  // namespace sdf
