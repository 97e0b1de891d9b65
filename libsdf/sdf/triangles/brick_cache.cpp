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
#include "sdf/base/fnv.h"

namespace sdf {
namespace {

namespace fs = std::filesystem;

// What a file begins with; to be changed with what samples are, or how they are written.
constexpr std::string_view kFormat = "libsdf bricks 3\n";
constexpr const char* kExtension = ".bricks";

/// FNV-1a of words instead of bytes.
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
    value_ = fnv(value_, word);
    value_ ^= value_ >> 32;  // bits of a word's upper half would never come down
  }
  std::uint64_t value_ = kFnvBegin<std::uint64_t>;
};

// Numbers go into a file as they lie in memory.
template <typename T>
void put(std::string& out, const T* from, std::size_t count) {
  out.append(reinterpret_cast<const char*>(from), count * sizeof(T));
}

/// Takes them out again, one after the other.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : left_(bytes) {}
  template <typename T>
  bool take(T* to, std::size_t count) {
    if (count > left_.size() / sizeof(T)) return false;
    std::memcpy(to, left_.data(), count * sizeof(T));
    left_.remove_prefix(count * sizeof(T));
    return true;
  }
  std::size_t left() const { return left_.size(); }

 private:
  std::string_view left_;
};

std::uint64_t hashOf(std::string_view bytes) {
  Hash hash;
  hash.add(bytes.data(), bytes.size());
  return hash.value();
}

// What a file holds beside the volumes, which have their names and kinds from Bricks.
template <typename B, typename Visit>
void eachNumber(B& b, const Visit& visit) {
  visit(b.voxel);
  visit(b.origin);
  visit(b.cells);
  visit(b.columns);
  visit(b.count);
  visit(b.worst);
  visit(b.rms);
}

std::string written(const Bricks& b) {
  std::string out;
  eachNumber(b, [&](const auto& number) { put(out, &number, 1); });
  for (const PayloadVolume& volume : b.volumes) {
    const std::uint64_t count = volume.values.size();
    put(out, &volume.size, 1);
    put(out, &count, 1);
    put(out, volume.values.data(), count);
  }
  return out;
}

bool readInto(std::string_view bytes, Bricks& b) {
  Reader in(bytes);
  bool whole = true;
  eachNumber(b, [&](auto& number) { whole = whole && in.take(&number, 1); });
  for (PayloadVolume& volume : b.volumes) {
    std::uint64_t count = 0;
    whole = whole && in.take(&volume.size, 1) && in.take(&count, 1) && count <= in.left();
    if (!whole) return false;
    volume.values.resize(count);
    whole = in.take(volume.values.data(), count);
  }
  return whole && in.left() == 0;
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
  const auto content = contentOf(file);
  if (Bricks kept; content && readInto(*content, kept)) {
    fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
    return kept;
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
