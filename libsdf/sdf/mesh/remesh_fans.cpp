#include "sdf/mesh/remesh_fans.h"

namespace sdf {

void Fans::begin(const glm::vec3& centre) {
  all.push_back({.centre = centre, .first = static_cast<std::uint32_t>(rim.size()), .count = 0});
}

void Fans::add(const RemeshTopology& mesh, std::uint32_t vertex, bool crease) {
  rim.push_back({mesh.positions[vertex], vertex, crease});
  ++all.back().count;
  all.back().creases += crease;
}

void Fans::addAround(const RemeshTopology& mesh, std::uint32_t v) {
  begin(mesh.positions[v]);
  all.back().centred = mesh.creasesAt(v) == 0 || mesh.creasesAt(v) == 2;
  std::uint32_t h = mesh.outgoing(v);
  do {
    add(mesh, mesh.to(h), mesh.isCrease(h));
    h = mesh.turned(h);
  } while (h != mesh.outgoing(v));
}

void Fans::addCollapsed(const RemeshTopology& mesh, std::uint32_t h) {
  const std::uint32_t u = mesh.from(h), v = mesh.to(h), g = mesh.twin(h);
  const int creases = mesh.creasesAt(v);
  begin(mesh.creasesAt(u) == creases ? 0.5f * (mesh.positions[u] + mesh.positions[v]) : mesh.positions[v]);
  all.back().centred = creases == 0 || creases == 2;
  // Around v from behind the edge, and around u; the corners across come once.
  std::uint32_t e = mesh.turned(g);
  add(mesh, mesh.to(e), mesh.isCrease(e) || mesh.isCrease(mesh.next(g)));
  for (e = mesh.turned(e); mesh.turned(e) != g; e = mesh.turned(e)) add(mesh, mesh.to(e), mesh.isCrease(e));
  e = mesh.turned(h);
  add(mesh, mesh.to(e), mesh.isCrease(e) || mesh.isCrease(mesh.next(h)));
  for (e = mesh.turned(e); mesh.turned(e) != h; e = mesh.turned(e)) add(mesh, mesh.to(e), mesh.isCrease(e));
}

void Fans::addEdge(const RemeshTopology& mesh, std::uint32_t h) {
  const std::uint32_t g = mesh.twin(h);
  begin(mesh.positions[mesh.from(h)]);
  all.back().closed = false;
  add(mesh, mesh.apex(g), false), add(mesh, mesh.to(h), mesh.isCrease(h)), add(mesh, mesh.apex(h), false);
}

void Fans::addFlipped(const RemeshTopology& mesh, std::uint32_t h) {
  const std::uint32_t g = mesh.twin(h);
  begin(mesh.positions[mesh.apex(h)]);
  all.back().closed = false;
  add(mesh, mesh.from(h), false), add(mesh, mesh.apex(g), false), add(mesh, mesh.to(h), false);
}

void Fans::addSplit(const RemeshTopology& mesh, std::uint32_t h) {
  const std::uint32_t g = mesh.twin(h);
  const bool crease = mesh.isCrease(h);
  begin(0.5f * (mesh.positions[mesh.from(h)] + mesh.positions[mesh.to(h)]));
  add(mesh, mesh.to(h), crease);
  add(mesh, mesh.apex(h), false);
  add(mesh, mesh.from(h), crease);
  add(mesh, mesh.apex(g), false);
}

}  // namespace sdf
