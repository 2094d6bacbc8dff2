// Guards tissue_codes.h: each code is a valid SNOMED CT code by its check digit. Each name and code occurs
// once and finds its row.
#include <set>

#include "tests/unit/suite.h"
#include "viewer/segment/tissue_codes.h"

using namespace volumen;

class TestTissueCodes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void codesEndInTheirCheckDigit();
  void namesAndCodesFindTheirRow();
  void categoriesAreThoseOfTheList();
};

namespace {

/// Verifies Verhoeff's check digit, which ends every SNOMED CT identifier: a multiplication in the dihedral
/// group of order 10.
bool hasCheckDigit(const std::string& digits) {
  const auto times = [](int a, int b) {
    const int rotated = a < 5   ? (b < 5 ? (a + b) % 5 : 5 + (a + b) % 5)
                        : b < 5 ? 5 + (a - b + 5) % 5
                                : (a - b + 5) % 5;
    return rotated;
  };
  constexpr int first[] = {1, 5, 7, 6, 2, 8, 3, 0, 9, 4};
  const auto permuted = [&](int digit, std::size_t place) {
    for (std::size_t n = 0; n < place % 8; ++n) digit = first[digit];
    return digit;
  };
  int check = 0;
  for (std::size_t n = 0; n < digits.size(); ++n)
    check = times(check, permuted(digits[digits.size() - 1 - n] - '0', n));
  return check == 0;
}

}  // namespace

void TestTissueCodes::codesEndInTheirCheckDigit() {
  QVERIFY(hasCheckDigit("272673000") && !hasCheckDigit("272673001") && !hasCheckDigit("227673000"));
  std::vector<Code> all{rightSide(), leftSide()};
  for (const Code& code : tissueCategories()) all.push_back(code);
  for (const TissueCode& tissue : tissueCodes()) all.push_back(tissue.type);
  for (const Code& code : all) {
    QCOMPARE(code.scheme, std::string("SCT"));
    QVERIFY2(!code.meaning.empty() && hasCheckDigit(code.value), code.meaning.c_str());
  }
}

void TestTissueCodes::namesAndCodesFindTheirRow() {
  std::set<std::string> names, values;
  for (const TissueCode& tissue : tissueCodes()) {
    QVERIFY2(names.insert(tissue.type.meaning).second, tissue.type.meaning.c_str());
    QVERIFY2(values.insert(tissue.type.value).second, tissue.type.meaning.c_str());
    QCOMPARE(tissueNamed(tissue.type.meaning), &tissue);
    QCOMPARE(tissueOf(tissue.type), &tissue);
  }
  QCOMPARE(tissueNamed("lIvEr")->type.value, std::string("10200004"));
  QCOMPARE(tissueNamed("Bone")->colour, glm::u8vec3(241, 214, 145));
  QCOMPARE(tissueNamed("Liv"), nullptr);
  QCOMPARE(tissueNamed(""), nullptr);
  QCOMPARE(tissueOf({}), nullptr);
  QCOMPARE(tissueOf({"10200004", "SRT", "Liver"}), nullptr);
  QCOMPARE(anyTissue().type.meaning, std::string("Tissue"));
  QVERIFY(tissueNamed("Kidney")->paired && !tissueNamed("Liver")->paired);
}

void TestTissueCodes::categoriesAreThoseOfTheList() {
  std::set<std::string> known;
  for (const Code& code : tissueCategories()) QVERIFY(known.insert(code.value).second);
  QCOMPARE(known.size(), std::size_t(5));
  for (const TissueCode& tissue : tissueCodes()) QVERIFY(known.contains(tissue.category.value));
}

VOLUMEN_TEST(TestTissueCodes);
#include "tst_tissue_codes.moc"
