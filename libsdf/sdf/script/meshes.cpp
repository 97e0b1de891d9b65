#include "sdf/script/meshes.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>

#include "sdf/meshfile/read_mesh.h"

namespace sdf {
namespace {

namespace fs = std::filesystem;

bool isWithin(const fs::path& file, const fs::path& folder) {
  const auto [rest, other] = std::ranges::mismatch(folder, file);
  return rest == folder.end();
}

/// What tells one state of a file from another.
using State = std::tuple<std::string, fs::file_time_type, std::uintmax_t, int>;

State stateOf(const fs::path& file, int voxels) {
  std::error_code code;
  const auto time = fs::last_write_time(file, code);
  const auto size = fs::file_size(file, code);
  return {file.string(), time, size, voxels};
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

// What was mended, beside what the reader says.
std::string noteOf(const MeshField& field, const std::vector<std::string>& warnings) {
  const ClosedTriangles& all = field.distance().triangles();
  std::string note;
  const auto say = [&](const std::string& what) { note += (note.empty() ? "" : "; ") + what; };
  for (const std::string& warning : warnings) say(warning);
  if (all.repeated > 0)
    say(counted(all.repeated, "triangle was", "triangles were") + " there more than once and left out");
  if (all.films > 0)
    say(counted(all.films, "triangle bounds", "triangles bound") + " no solid and " +
        (all.films == 1 ? "is" : "are") + " left out of the distance");
  if (all.holes > 0) say(counted(all.holes, "hole was", "holes were") + " closed");
  if (all.turned > 0)
    say(counted(all.turned, "triangle was", "triangles were") + " turned to agree with its neighbours");
  if (field.distance().signBy() == SignBy::Winding)
    say("its surface crosses or touches itself, or is turned inside out: inside is what it winds around");
  return note;
}

}  // namespace

Result<fs::path> permitted(const std::string& name, const fs::path& scene, const ScriptOptions& options,
                           const std::string& function) {
  std::error_code code;
  const fs::path own = fs::weakly_canonical(fs::absolute(scene), code).parent_path();
  const fs::path file = fs::weakly_canonical(own / name, code);
  std::vector<fs::path> folders{own};
  for (const fs::path& folder : options.folders) folders.push_back(fs::weakly_canonical(folder, code));
  if (std::ranges::any_of(folders, [&](const fs::path& folder) { return isWithin(file, folder); }))
    return file;
  return Error{ErrorKind::Scene, function + ": '" + name +
                                     "' lies outside of the scene's folder; move it there, or allow " +
                                     "its folder with --allow-dir " + file.parent_path().string()};
}

Result<NotedField> meshField(const fs::path& file, int voxels, const fs::path& cache) {
  struct Kept {
    std::weak_ptr<const MeshField> field;
    std::string note;
  };
  static std::mutex mutex;
  static std::map<State, Kept> kept;
  const State state = stateOf(file, voxels);
  {
    const std::lock_guard lock(mutex);
    std::erase_if(kept, [](const auto& entry) { return entry.second.field.expired(); });
    if (const auto found = kept.find(state); found != kept.end())
      if (auto field = found->second.field.lock()) return NotedField{std::move(field), found->second.note};
  }
  Result<ReadMesh> mesh = readMesh(file);
  if (!mesh) return mesh.error();
  auto field = MeshField::make(std::move(mesh->mesh), voxels, cache);
  if (!field) return Error{field.error().kind, file.string() + ": " + field.error().message};
  NotedField made{*field, noteOf(**field, mesh->warnings)};
  const std::lock_guard lock(mutex);
  kept[state] = {made.field, made.note};
  return made;
}

}  // namespace sdf
