// Every operator of the catalog, held to the same operation on meshes.
#include <gtest/gtest.h>

#include "accuracy/operators/operator_cases.h"
#include "sdf/shape/catalog.h"
#include "support/thorough.h"

namespace sdf::accuracy {

namespace operators_test {

bool isOperator(const CatalogEntry& e) { return e.group != Group::Solid && e.group != Group::Flat; }

TEST(Operators, HaveCasesForEveryEntryOfTheCatalogInItsOrder) {
  std::vector<std::string> wanted, had;
  for (const CatalogEntry& e : catalog())
    if (isOperator(e)) wanted.push_back(e.name);
  for (const OperatorCases& cases : operatorCases()) had.push_back(cases.entry);
  EXPECT_EQ(had, wanted);
}

class Operator : public testing::TestWithParam<OperatorCases> {};

TEST_P(Operator, BuildsEveryCase) {
  for (const ReferenceCase& c : GetParam().make())
    EXPECT_TRUE(c.shape.ok()) << c.name << ": " << *c.shape.error;
}

TEST_P(Operator, KeepsItsClaimAgainstTheSameOperationOnMeshes) {
  const std::uint64_t fraction = test::accuracyFraction();
  const Row row = operatorRow(GetParam(), fraction);
  EXPECT_EQ(row.found.refuted, 0u) << row.found.worst;
  EXPECT_GE(row.found.points, 100'000 / fraction);
}

INSTANTIATE_TEST_SUITE_P(Catalog, Operator, testing::ValuesIn(operatorCases()),
                         [](const auto& info) { return info.param.entry; });

}  // namespace operators_test
}  // namespace sdf::accuracy
