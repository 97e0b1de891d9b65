#include "sdf/mesh/refine/remesh_fans.h"

namespace sdf {

void Fans::begin(const glm::vec3& centre) {
  all.push_back({.centre = centre, .first = static_cast<std::uint32_t>(rim.size()), .count = 0});
}

// `triangle` is one of its half-edges.
void Fans::add(const HalfEdgeMesh& mesh, std::uint32_t vertex, bool crease, std::uint32_t triangle) {
  rim.push_back({mesh.positions[vertex], vertex, crease, mesh.material(triangle)});
  ++all.back().count;
  all.back().creases += crease;
}

void Fans::addAround(const HalfEdgeMesh& mesh, std::uint32_t v) {
  begin(mesh.positions[v]);
  all.back().centred = mesh.creasesAt(v) == 0 || mesh.creasesAt(v) == 2;
  std::uint32_t h = mesh.outgoing(v);
  do {
    add(mesh, mesh.to(h), mesh.isCrease(h), h);
    h = mesh.turned(h);
  } while (h != mesh.outgoing(v));
}

void Fans::addCollapsed(const HalfEdgeMesh& mesh, std::uint32_t h) {
  const std::uint32_t u = mesh.from(h), v = mesh.to(h), g = mesh.twin(h);
  const int creases = mesh.creasesAt(v);
  begin(mesh.creasesAt(u) == creases ? 0.5f * (mesh.positions[u] + mesh.positions[v]) : mesh.positions[v]);
  all.back().centred = creases == 0 || creases == 2;
  // Around v from behind the edge, and around u; the corners across come once.
  std::uint32_t e = mesh.turned(g);
  add(mesh, mesh.to(e), mesh.isCrease(e) || mesh.isCrease(mesh.next(g)), e);
  for (e = mesh.turned(e); mesh.turned(e) != g; e = mesh.turned(e))
    add(mesh, mesh.to(e), mesh.isCrease(e), e);
  e = mesh.turned(h);
  add(mesh, mesh.to(e), mesh.isCrease(e) || mesh.isCrease(mesh.next(h)), e);
  for (e = mesh.turned(e); mesh.turned(e) != h; e = mesh.turned(e))
    add(mesh, mesh.to(e), mesh.isCrease(e), e);
}

void Fans::addEdge(const HalfEdgeMesh& mesh, std::uint32_t h) {
  const std::uint32_t g = mesh.twin(h);
  begin(mesh.positions[mesh.from(h)]);
  all.back().closed = false;
  add(mesh, mesh.apex(g), false, g), add(mesh, mesh.to(h), mesh.isCrease(h), h);
  add(mesh, mesh.apex(h), false, h);
}

void Fans::addFlipped(const HalfEdgeMesh& mesh, std::uint32_t h) {
  const std::uint32_t g = mesh.twin(h);
  begin(mesh.positions[mesh.apex(h)]);
  all.back().closed = false;
  add(mesh, mesh.from(h), false, h), add(mesh, mesh.apex(g), false, h), add(mesh, mesh.to(h), false, h);
}

void Fans::addSplit(const HalfEdgeMesh& mesh, std::uint32_t h) {
  const std::uint32_t g = mesh.twin(h);
  const bool crease = mesh.isCrease(h);
  begin(0.5f * (mesh.positions[mesh.from(h)] + mesh.positions[mesh.to(h)]));
  add(mesh, mesh.to(h), crease, h);
  add(mesh, mesh.apex(h), false, h);
  add(mesh, mesh.from(h), crease, g);
  add(mesh, mesh.apex(g), false, g);
}

}  // namespace sdf
