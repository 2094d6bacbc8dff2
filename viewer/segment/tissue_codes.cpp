#include "viewer/segment/tissue_codes.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace volumen {

namespace {

Code sct(const char* value, const char* meaning) { return {value, "SCT", meaning}; }

const std::vector<Code>& categories() {
  static const std::vector<Code> all{
      sct("85756007", "Tissue"),
      sct("123037004", "Anatomical Structure"),
      sct("49755003", "Morphologically Altered Structure"),
      sct("91720002", "Body Substance"),
      sct("260787004", "Physical object"),
  };
  return all;
}

const std::vector<TissueCode>& table() {
  static const Code &tissue = categories()[0], &structure = categories()[1], &altered = categories()[2],
                    &object = categories()[4];
  static const std::vector<TissueCode> all{
      {tissue, tissue, {128, 174, 128}},
      {tissue, sct("272673000", "Bone"), {241, 214, 145}},
      {tissue, sct("51114001", "Artery"), {216, 101, 79}},
      {tissue, sct("29092000", "Vein"), {0, 151, 206}},
      {tissue, sct("59820001", "Blood vessel"), {216, 60, 50}},
      {tissue, sct("248300009", "Body fat"), {230, 220, 70}},
      {tissue, sct("67769002", "Subcutaneous fat"), {255, 242, 178}},
      {tissue, sct("71616004", "Muscle"), {192, 104, 88}},
      {tissue, sct("39937001", "Skin"), {177, 122, 101}},
      {tissue, sct("309312004", "Cartilage"), {111, 184, 210}},
      {tissue, sct("59441001", "Lymph node"), {68, 172, 100}},
      {tissue, sct("119410002", "Nerve"), {244, 214, 49}},
      {structure, sct("38266002", "Entire body"), {177, 122, 101}},
      {structure, sct("69536005", "Head"), {177, 122, 101}},
      {structure, sct("12738006", "Brain"), {250, 250, 225}},
      {structure, sct("89546000", "Skull"), {241, 213, 144}},
      {structure, sct("91609006", "Mandible"), {222, 198, 101}},
      {structure, sct("113197003", "Rib"), {253, 232, 158}, true},
      {structure, sct("56873002", "Sternum"), {244, 217, 154}},
      {structure, sct("51282000", "Vertebra"), {226, 202, 134}},
      {structure, sct("71341001", "Femur"), {248, 212, 62}, true},
      {structure, sct("39607008", "Lung"), {197, 165, 145}, true},
      {structure, sct("45653009", "Upper lobe of lung"), {172, 138, 115}, true},
      {structure, sct("90572001", "Lower lobe of lung"), {224, 186, 162}, true},
      {structure, sct("44567001", "Trachea"), {182, 228, 255}},
      {structure, sct("89187006", "Airway structure"), {182, 228, 255}},
      {structure, sct("110726009", "Trachea and bronchus"), {175, 216, 244}},
      {structure, sct("80891009", "Heart"), {206, 110, 84}},
      {structure, sct("74281007", "Myocardium"), {200, 0, 20}},
      {structure, sct("82471001", "Left atrium"), {203, 108, 81}},
      {structure, sct("87878005", "Left ventricle"), {152, 55, 13}},
      {structure, sct("53085002", "Right ventricle"), {181, 85, 57}},
      {structure, sct("15825003", "Aorta"), {224, 97, 76}},
      {structure, sct("81040000", "Pulmonary artery"), {0, 122, 171}},
      {structure, sct("122972007", "Pulmonary vein"), {186, 77, 64}},
      {structure, sct("64131007", "Inferior vena cava"), {0, 70, 200}},
      {structure, sct("32764006", "Portal vein"), {0, 90, 220}},
      {structure, sct("10200004", "Liver"), {221, 130, 101}},
      {structure, sct("78961009", "Spleen"), {157, 108, 162}},
      {structure, sct("64033007", "Kidney"), {185, 102, 83}, true},
      {structure, sct("23451007", "Adrenal gland"), {249, 186, 150}, true},
      {structure, sct("15776009", "Pancreas"), {249, 180, 111}},
      {structure, sct("28231008", "Gallbladder"), {139, 150, 98}},
      {structure, sct("69695003", "Stomach"), {216, 132, 105}},
      {structure, sct("71854001", "Colon"), {204, 168, 143}},
      {structure, sct("89837001", "Bladder"), {222, 154, 132}},
      {structure, sct("41216001", "Prostate"), {230, 158, 140}},
      {structure, sct("69748006", "Thyroid"), {62, 162, 114}},
      {structure, sct("2748008", "Spinal cord"), {244, 214, 49}},
      {altered, sct("4147007", "Mass"), {144, 238, 144}},
      {altered, sct("108369006", "Neoplasm"), {255, 0, 200}},
      {object, sct("40388003", "Implant"), {160, 160, 170}},
  };
  return all;
}

bool sameWord(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

std::span<const TissueCode> tissueCodes() { return table(); }

std::span<const Code> tissueCategories() { return categories(); }

const TissueCode& anyTissue() { return table().front(); }

const TissueCode* tissueNamed(std::string_view name) {
  const auto found =
      std::ranges::find_if(table(), [&](const TissueCode& t) { return sameWord(t.type.meaning, name); });
  return found == table().end() ? nullptr : &*found;
}

const TissueCode* tissueOf(const Code& type) {
  const auto found = std::ranges::find_if(table(), [&](const TissueCode& t) {
    return t.type.value == type.value && t.type.scheme == type.scheme;
  });
  return found == table().end() ? nullptr : &*found;
}

const Code& rightSide() {
  static const Code side = sct("24028007", "Right");
  return side;
}

const Code& leftSide() {
  static const Code side = sct("7771000", "Left");
  return side;
}

}  // namespace volumen
