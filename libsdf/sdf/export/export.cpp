#include "sdf/export/export.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <variant>

#include "sdf/base/file.h"
#include "sdf/export/plain.h"
#include "sdf/gltf/gltf.h"

namespace sdf {
namespace {

struct Format {
  std::string_view extension;
  std::variant<GltfContainer, PlainFormat> encoding;
};

constexpr std::array kFormats{Format{".glb", GltfContainer::Binary}, Format{".gltf", GltfContainer::Text},
                              Format{".stl", PlainFormat::Stl}, Format{".ply", PlainFormat::Ply},
                              Format{".obj", PlainFormat::Obj}};

const Format* findFormat(const std::filesystem::path& target) {
  const auto found = std::ranges::find(kFormats, lowerExtension(target), &Format::extension);
  return found == kFormats.end() ? nullptr : &*found;
}

}  // namespace

Status checkExtension(const std::filesystem::path& target) {
  std::vector<std::string_view> known;
  for (const Format& format : kFormats) known.push_back(format.extension);
  return checkExtension(target, known);
}

bool isGltf(const std::filesystem::path& target) {
  return std::holds_alternative<GltfContainer>(findFormat(target)->encoding);
}

std::vector<Part> exportedParts(const Scene& scene, const std::filesystem::path& target) {
  if (isGltf(target) || scene.parts.size() < 2) return scene.parts;
  return {Part{"all parts united", scene.whole()}};
}

Status writeAnimation(const std::filesystem::path& target, const Animation& animation) {
  if (Status known = checkExtension(target); !known) return known;
  const auto* container = std::get_if<GltfContainer>(&findFormat(target)->encoding);
  if (!container)
    return Error{
        ErrorKind::Usage,
        lowerExtension(target) + " files hold no animation; write .glb or .gltf, or a file for each frame"};
  return writeFile(target, [&](std::ostream& out) { return encodeAnimation(out, *container, animation); });
}

Status writeMeshes(const std::filesystem::path& target, const Scene& scene,
                   const std::vector<ExportPart>& parts) {
  if (Status known = checkExtension(target); !known) return known;
  const auto& encoding = findFormat(target)->encoding;
  return writeFile(target, [&](std::ostream& out) {
    if (const auto* plain = std::get_if<PlainFormat>(&encoding)) return encodePlain(out, *plain, parts);
    return encodeGltf(out, std::get<GltfContainer>(encoding), scene, parts);
  });
}

}  // namespace sdf
