#include "sdf/gltf/read_mesh.h"

#include <array>
#include <exception>
#include <new>
#include <string_view>

#include "sdf/base/file.h"
#include "sdf/gltf/read_formats.h"

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

Result<ReadMesh> readTidy(const std::filesystem::path& path, Reader read) {
  const Result<MeshFile> file = readWhole(path);
  if (!file) return file.error();
  Result<ReadMesh> mesh = read(*file);
  if (!mesh) return mesh;
  if (Status tidied = tidy(path, *mesh); !tidied) return tidied.error();
  return mesh;
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

// Libraries that take a file apart may throw what they like.
Result<ReadMesh> readMesh(const std::filesystem::path& file) {
  if (Status known = checkReadable(file); !known) return known.error();
  try {
    return readTidy(file, readableAs(file)->read);
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::Limits,
                 unreadable(file, "it needs more memory than there is; simplify it").message};
  } catch (const std::exception& broken) {
    return unreadable(file, "it is broken: " + inQuotes(broken.what()));
  }
}

}  // namespace sdf
