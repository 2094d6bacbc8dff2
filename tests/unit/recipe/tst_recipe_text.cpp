// Guards segment.md: the text of a recipe with all fields stays the same.
#include <nlohmann/json.hpp>

#include "tests/unit/suite.h"
#include "viewer/recipe/recipe.h"

using namespace volumen;

class TestRecipeText : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theTextOfARecipeIsFixed();
};

void TestRecipeText::theTextOfARecipeIsFixed() {
  Segment bone;
  bone.number = 1;
  bone.label = "Bone";
  bone.description = "hard";
  bone.category = {"85756007", "SCT", "Tissue"};
  bone.type = {"272673000", "SCT", "Bone"};
  bone.modifier = {"7771000", "SCT", "Left"};
  bone.colour = glm::u8vec3(0, 128, 255);
  const Recipe recipe{"R",
                      "All fields",
                      {"CT"},
                      {bone},
                      {{"range", "Bone", {{"low", 200.0}, {"high", 3000.5}}},
                       {"scissors",
                        "Bone",
                        {{"outline", std::vector<glm::dvec3>{{0, 10.5, -5}}},
                         {"sight", std::vector<glm::dvec3>{{0, 1, 0}}},
                         {"perspective", true}}},
                       {"fill", "Bone", {{"across", std::string("i")}}},
                       {"joint", "Bone", {{"with", std::vector<std::string>{"Bone"}}}}},
                      true};
  const QString steps = QStringLiteral(
      R"([{"step":"range","segment":"Bone","low":200.0,"high":3000.5},)"
      R"({"step":"scissors","segment":"Bone","outline":[[0.0,10.5,-5.0]],"sight":[[0.0,1.0,0.0]],"perspective":true},)"
      R"({"step":"fill","segment":"Bone","across":"i"},{"step":"joint","segment":"Bone","with":["Bone"]}])");
  QCOMPARE(QString::fromStdString(stepsJson(recipe.steps)), steps);
  const std::string text = recipeJson(recipe);
  QVERIFY(text.starts_with("{\n  \"volumenRecipe\": 1,\n") && text.ends_with("\n}\n"));
  QCOMPARE(
      QString::fromStdString(nlohmann::ordered_json::parse(text).dump()),
      QStringLiteral(
          R"({"volumenRecipe":1,"name":"R","description":"All fields","modalities":["CT"],"contrast":true,)"
          R"("segments":[{"name":"Bone","description":"hard",)"
          R"("category":{"value":"85756007","scheme":"SCT","meaning":"Tissue"},)"
          R"("type":{"value":"272673000","scheme":"SCT","meaning":"Bone"},)"
          R"("modifier":{"value":"7771000","scheme":"SCT","meaning":"Left"},"colour":[0,128,255]}],"steps":%1})")
          .arg(steps));
  const auto read = readRecipe(text);
  QVERIFY2(read, read ? "" : read.message().c_str());
  QVERIFY(*read == recipe);
}

VOLUMEN_TEST(TestRecipeText);
#include "tst_recipe_text.moc"
