#include "sdf/meshfile/read_mesh.h"

#include <array>
#include <exception>
#include <new>
#include <string_view>

#include "sdf/base/file.h"
#include "sdf/meshfile/read_formats.h"

namespace sdf {
namespace {

using Reader = Result<ReadMesh> (*)(const MeshFile&);
struct Readable {
  std::string_view extension;
  Reader read;
};

constexpr std::array<Readable, 5> kReadable{
    {{".glb", readGltf}, {".gltf", readGltf}, {".obj", readObj}, {".stl", readStl}, {".ply", readPly}}};

const Readable* readableAs(const std::filesystem::path& file) {
  const std::string extension = lowerExtension(file);
  for (const Readable& one : kReadable)
    if (one.extension == extension) return &one;
  return nullptr;
}

}  // namespace

Status checkReadable(const std::filesystem::path& file) {
  if (readableAs(file)) return okStatus();
  const std::string extension = file.extension().string();
  std::string message = "'" + file.string() + "' has ";
  message += extension.empty() ? "no extension" : "the unknown extension '" + extension + "'";
  message += "; meshes are read from";
  for (const Readable& one : kReadable) message.append(" ").append(one.extension);
  return Error{ErrorKind::Usage, std::move(message)};
}

Result<ReadMesh> readMesh(const std::filesystem::path& file) {
  if (Status known = checkReadable(file); !known) return known.error();
  const Result<MeshFile> whole = readWhole(file);
  return whole ? readMesh(*whole) : whole.error();
}

// Libraries that take a file apart may throw what they like.
Result<ReadMesh> readMesh(const MeshFile& file) {
  if (Status known = checkReadable(file.path); !known) return known.error();
  try {
    Result<ReadMesh> read = readableAs(file.path)->read(file);
    if (!read) return read;
    if (Status tidied = tidy(file.path, *read); !tidied) return tidied.error();
    return read;
  } catch (const std::bad_alloc&) {
    const std::string why = "it needs more memory than there is; simplify it";
    return Error{ErrorKind::Limits, unreadable(file.path, why).message};
  } catch (const std::exception& broken) {
    return unreadable(file.path, "it is broken: " + onOneLine(broken.what()));
  }
}

}  // namespace sdf
