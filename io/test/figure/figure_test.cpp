#include "halfspace/io/figure.hpp"

#include <gtest/gtest.h>

namespace halfspace::io {
namespace {

Figure square_with_hole() {
  Figure figure;
  figure.width = 20;
  figure.height = 10;
  FigureRegion region;
  region.fill = {255, 128, 0};
  region.loops = {{{1, 1}, {9.5, 1}, {9.5, 9}, {1, 9}},
                  {{2, 2}, {2, 3.25}, {3.0625, 3.25}}};
  region.title = "a < b & \"c\"";
  figure.regions.push_back(region);
  return figure;
}

bool holds(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

TEST(Figure, PathsAreEvenOddWithShortDecimals) {
  const std::string svg = *figure_bytes(".svg", square_with_hole());
  EXPECT_TRUE(holds(svg, "M1 1L9.5 1 9.5 9 1 9ZM2 2L2 3.25 3.062 3.25Z"));
  EXPECT_TRUE(holds(svg, "fill-rule=\"evenodd\""));
  EXPECT_TRUE(holds(svg, "fill=\"#ff8000\""));
  EXPECT_TRUE(holds(svg, "a &lt; b &amp; &quot;c&quot;"));
}

TEST(Figure, RegionsAreDrawnWithAStrokeAndThenWithout) {
  const std::string svg = *figure_bytes(".svg", square_with_hole());
  EXPECT_LT(svg.find("stroke-width=\"1\""), svg.find("stroke-width=\"0\""));
  const std::string eps = *figure_bytes(".eps", square_with_hole());
  EXPECT_LT(eps.find("gsave eofill grestore stroke"), eps.rfind("eofill\n"));
}

TEST(Figure, YGrowsUpwardsWhereTheFormatSaysSo) {
  const std::string eps = *figure_bytes(".eps", square_with_hole());
  EXPECT_TRUE(holds(eps, "1 9 m\n9.5 9 l\n9.5 1 l\n1 1 l\nh\n"));
  EXPECT_TRUE(holds(eps, "%%BoundingBox: 0 0 20 10"));
}

TEST(Figure, PointsThatFallTogetherAreOne) {
  Figure figure = square_with_hole();
  figure.regions[0].loops = {{{1, 1}, {1.0001, 1}, {5, 1}, {5, 5}, {1, 1.0002}},
                             {{2, 2}, {2.0001, 2}, {2, 2.0001}}};
  const std::string svg = *figure_bytes(".svg", figure);
  EXPECT_TRUE(holds(svg, "d=\"M1 1L5 1 5 5Z\""));
}

TEST(Figure, TheCrossReferencesOfAPdfAreRight) {
  const std::string pdf = *figure_bytes(".pdf", square_with_hole());
  for (int k = 1; k <= 4; ++k) {
    const std::string head = std::to_string(k) + " 0 obj\n";
    const std::string place = std::to_string(pdf.find("\n" + head) + 1);
    const std::string entry =
        std::string(10 - place.size(), '0') + place + " 00000 n \n";
    EXPECT_TRUE(holds(pdf, entry)) << k;
  }
  EXPECT_TRUE(holds(pdf, "startxref\n" + std::to_string(pdf.find("xref\n"))));
}

TEST(Figure, TheBackgroundIsDrawnFirstWithStrokesAndLastWithout) {
  Figure figure = square_with_hole();
  figure.regions.push_back(figure.regions[0]);
  figure.regions[1].fill = {0, 0, 255};
  figure.regions[1].is_background = true;
  const std::string eps = *figure_bytes(".eps", figure);
  const std::string_view orange = "1 0.502 0 c", blue = "0 0 1 c";
  EXPECT_LT(eps.find(blue), eps.find(orange));
  EXPECT_LT(eps.rfind(orange), eps.rfind(blue));
}

Figure lines() {
  Figure figure;
  figure.width = figure.height = 20;
  figure.unit_mm = 1;
  FigureStrokes strokes;
  strokes.name = "crease";
  strokes.strokes = {
      {{0, 0}, {4, 0}, {}}, {{9, 9}, {5, 0}, {}}, {{9, 9}, {9, 3}, {}}};
  order_for_pen(strokes.strokes);
  strokes.dashes = {2, 1};
  figure.strokes.push_back(strokes);
  return figure;
}

TEST(Figure, APenGoesOnWhereItIsOrToTheNearestEnd) {
  const auto strokes = lines().strokes[0].strokes;
  const FigureStroke turned = {{5, 0}, {9, 9}, {}};
  ASSERT_EQ(strokes.size(), 3u);
  EXPECT_EQ(strokes[1], turned);
  EXPECT_EQ(strokes[2], (FigureStroke{{9, 9}, {9, 3}, {}}));
}

TEST(Figure, PlottersGetMillimetres) {
  const std::string hpgl = *figure_bytes(".hpgl", lines());
  EXPECT_TRUE(holds(hpgl, "SP1;LT2,1;\nPU0,800;PD160,800;\n"));
  EXPECT_TRUE(holds(hpgl, "PU200,800;PD360,440,360,680;\n"));
  const std::string dxf = *figure_bytes(".dxf", lines());
  EXPECT_TRUE(holds(dxf, "LINE\n8\ncrease\n10\n0\n20\n20\n30\n0\n11\n4"));
}

TEST(Figure, HatchingStaysInsideOfARegion) {
  FigureRegion square;
  square.loops = {{{0, 0}, {8, 0}, {8, 8}, {0, 8}},
                  {{2, 2}, {6, 2}, {6, 6}, {2, 6}}};
  const auto strokes = hatching(square, 1);
  EXPECT_GT(strokes.size(), 10u);
  for (const FigureStroke& stroke : strokes) {
    const double x = (stroke.from[0] + stroke.to[0]) / 2;
    const double y = (stroke.from[1] + stroke.to[1]) / 2;
    EXPECT_TRUE(x >= 0 && x <= 8 && y >= 0 && y <= 8);
    EXPECT_FALSE(x > 2 && x < 6 && y > 2 && y < 6);
  }
}

TEST(Figure, AnEmptyFigureIsAValidFile) {
  Figure figure;
  figure.width = figure.height = 1;
  for (const char* ending : {".svg", ".pdf", ".eps", ".tex", ".dxf", ".hpgl"})
    EXPECT_TRUE(figure_bytes(ending, figure).has_value()) << ending;
  EXPECT_EQ(figure_bytes(".png", figure).error().code,
            ErrorCode::kUnknownFormat);
}

}  // namespace
}  // namespace halfspace::io
