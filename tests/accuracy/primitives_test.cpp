// Every solid and flat shape against its geometry.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <ostream>
#include <set>
#include <span>
#include <sstream>

#include "accuracy/rows.h"
#include "accuracy/solids/primitive_cases.h"
#include "sdf/shape/catalog.h"
#include "support/thorough.h"

namespace sdf::accuracy {

static void PrintTo(const PrimitiveCases& c, std::ostream* out) { *out << c.entry; }

namespace primitives_test {

std::set<std::string> primitiveEntries() {
  std::set<std::string> names;
  for (const CatalogEntry& e : catalog())
    if (e.group == Group::Solid || e.group == Group::Flat) names.insert(e.name);
  return names;
}

class Primitive : public testing::TestWithParam<PrimitiveCases> {};

TEST_P(Primitive, KeepsItsClaimAgainstItsGeometry) {
  const std::uint64_t fraction = test::accuracyFraction();
  const Row row = rowOf(GetParam().entry, GetParam().makers, fraction);
  EXPECT_EQ(row.found.refuted, 0u) << row.found.worst;
  EXPECT_GE(row.found.points, 100'000 / fraction);
}

INSTANTIATE_TEST_SUITE_P(Catalog, Primitive, testing::ValuesIn(primitiveCases()),
                         [](const auto& info) { return info.param.entry; });

TEST(Primitives, AllHaveCases) {
  std::set<std::string> names;
  for (const PrimitiveCases& cases : primitiveCases()) names.insert(cases.entry);
  EXPECT_EQ(names, primitiveEntries());
}

TEST(Report, HasARowForEveryEntryAndNothingRefuted) {
  std::ostringstream page;
  page << std::ifstream(SDF_SOURCE_DIR "/docs/accuracy.md").rdbuf();
  for (const CatalogEntry& e : catalog())
    EXPECT_NE(page.str().find("\n| `" + e.name + "` |"), std::string::npos)
        << e.name << " is missing: run accuracy docs/accuracy.md";
  EXPECT_EQ(page.str().find("refuted**"), std::string::npos);
}

}  // namespace primitives_test
}  // namespace sdf::accuracy
