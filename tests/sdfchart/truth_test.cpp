// The error measures held to what geometry says of a sphere and of a box.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "reference/reference.h"
#include "sdfchart/truth/mesh_truth.h"

namespace sdf::chart {
namespace truth_test {

using accuracy::kPi;
using accuracy::TriangleMesh;

Subject subjectNamed(const std::string& name) {
  for (Subject& s : standardSubjects(false))
    if (s.name == name) return s;
  throw std::runtime_error("no such subject");
}

constexpr std::size_t kPoints = 20'000;

// An octahedron whose triangles are cut into four, so many times, all corners on the ball of this radius.
TriangleMesh inscribed(int times, double radius) {
  TriangleMesh mesh;
  mesh.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int i = 0; i < times; ++i) {
    std::vector<glm::ivec3> finer;
    const auto middle = [&](int a, int b) {
      mesh.points.push_back(glm::normalize(mesh.points[a] + mesh.points[b]));
      return static_cast<int>(mesh.points.size()) - 1;
    };
    for (const glm::ivec3& t : mesh.triangles) {
      const int a = middle(t.x, t.y), b = middle(t.y, t.z), c = middle(t.z, t.x);
      for (const glm::ivec3& f : {glm::ivec3(t.x, a, c), {a, t.y, b}, {c, b, t.z}, {a, b, c}})
        finer.push_back(f);
    }
    mesh.triangles = finer;
  }
  for (glm::dvec3& p : mesh.points) p *= radius;
  return mesh;
}

TriangleMesh boxMesh(const glm::dvec3& half) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.push_back(half * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

// The deepest point of a facet lies at its circumcentre, sqrt(1 - r^2) from the middle of the ball.
double sagitta(const TriangleMesh& mesh) {
  double deepest = 0.0;
  for (const glm::ivec3& t : mesh.triangles) {
    const glm::dvec3 &a = mesh.points[t.x], &b = mesh.points[t.y], &c = mesh.points[t.z];
    const double twice = glm::length(glm::cross(b - a, c - a));
    const double r = glm::distance(a, b) * glm::distance(b, c) * glm::distance(c, a) / (2.0 * twice);
    deepest = std::max(deepest, 1.0 - std::sqrt(1.0 - r * r));
  }
  return deepest;
}

TEST(MeshTruth, MeasuresTheSagittaOfFacetsOnABall) {
  const Subject ball = subjectNamed("ball");
  const auto truth = truthOf(ball, kPoints);
  const TriangleMesh mesh = inscribed(3, 1.0);
  Row row;
  judgeMesh({mesh}, *truth, kPoints, row);
  EXPECT_LE(row.max, sagitta(mesh) + row.truth);
  EXPECT_GT(row.max, 0.97 * sagitta(mesh));
  EXPECT_EQ(row.triangles, 512.0);
  EXPECT_LT(row.rms, row.max);
}

TEST(MeshTruth, MeasuresABallThatIsTooLarge) {
  const Subject ball = subjectNamed("ball");
  const auto truth = truthOf(ball, kPoints);
  const TriangleMesh fine = inscribed(6, 1.1);
  Row row;
  judgeMesh({fine}, *truth, kPoints, row);
  const double chord = 1.1 * sagitta(inscribed(6, 1.0));
  EXPECT_NEAR(row.max, 0.1, chord + row.truth);
  EXPECT_NEAR(row.rms, 0.1, chord + row.truth);
  EXPECT_LT(row.normal, 2.0);
}

TEST(MeshTruth, NormalsThatLeanAreMeasured) {
  const Subject ball = subjectNamed("ball");
  const auto truth = truthOf(ball, kPoints);
  JudgedMesh judged{inscribed(5, 1.0)};
  constexpr double kLean = 10.0;  // degrees
  for (const glm::ivec3& t : judged.mesh.triangles) {
    std::array<glm::dvec3, 3> normals;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 n = glm::normalize(judged.mesh.points[t[k]]);
      const glm::dvec3 aside = glm::normalize(glm::cross(n, glm::dvec3(0.3, 0.5, 0.8)));
      normals[k] = std::cos(kLean * kPi / 180.0) * n + std::sin(kLean * kPi / 180.0) * aside;
    }
    judged.normals.push_back(normals);
  }
  Row row;
  judgeMesh(judged, *truth, kPoints, row);
  EXPECT_NEAR(row.normal, kLean, 0.1);
}

TEST(MeshTruth, OfABoxKnowsItsCorners) {
  const Subject subject = subjectNamed("box");
  const auto truth = truthOf(subject, kPoints);
  const glm::dvec3 half = 0.5 * subject.bounds.size();
  Row same, larger;
  judgeMesh({boxMesh(half)}, *truth, kPoints, same);
  EXPECT_LE(same.max, 1e-7);  // the bounds are rounded outwards
  EXPECT_LE(same.normal, 1e-6);
  judgeMesh({boxMesh(half + 0.1)}, *truth, kPoints, larger);
  EXPECT_NEAR(larger.max, 0.1 * std::sqrt(3.0), 1e-6);  // from the mesh's corners
}

TEST(MeshTruth, SeesWhatTheMeshLacks) {
  const Subject subject = subjectNamed("box");
  const auto truth = truthOf(subject, kPoints);
  TriangleMesh open = boxMesh(0.5 * subject.bounds.size());
  open.triangles.resize(10);  // without the side at +x
  Row row;
  judgeMesh({open}, *truth, kPoints, row);
  // From the middle of the missing side to the nearest of the others: half the shorter way across it.
  EXPECT_NEAR(row.max, 0.5 * std::min(subject.bounds.size().y, subject.bounds.size().z), 0.03);
}

TEST(MeshTruth, WithoutADefinitionAgreesWithTheDefinition) {
  Subject ball = subjectNamed("ball");
  const auto exact = truthOf(ball, kPoints);
  ball.solid = nullptr;
  const auto fine = truthOf(ball, kPoints);
  const JudgedMesh judged{inscribed(3, 1.0)};
  Row byDefinition, byMesh;
  judgeMesh(judged, *exact, kPoints, byDefinition);
  judgeMesh(judged, *fine, kPoints, byMesh);
  const double error = byMesh.truth + byDefinition.truth;
  EXPECT_NEAR(byMesh.max, byDefinition.max, error + 0.02 * byDefinition.max);
  EXPECT_NEAR(byMesh.rms, byDefinition.rms, error + 0.02 * byDefinition.rms);
}

TEST(MeshTruth, RefusesAMeshOfNothing) {
  const auto truth = truthOf(subjectNamed("ball"), 10);
  Row row;
  EXPECT_THROW(judgeMesh({}, *truth, 10, row), std::runtime_error);
}

}  // namespace truth_test
}  // namespace sdf::chart
