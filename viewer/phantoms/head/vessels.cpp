#include <vector>

#include "viewer/phantoms/head/anatomy.h"

namespace volumen::head {

namespace {

struct Point {
  Vec at;
  float radius;
};

// Courses on the left side; the right side mirrors them. The basilar artery and the sinuses run in the
// middle.
constexpr Point carotid[] = {{{30, 2, -150}, 3.6f}, {{29, 0, -110}, 3.6f}, {{27, 6, -80}, 3},
                             {{25, 8, -50}, 2.6f},  {{25, 8, -26}, 2.5f},  {{22, 2, -16}, 2.5f},
                             {{13, 0, -12}, 2.4f},  {{10, -8, -4}, 2.4f},  {{10, -20, -1}, 2.3f},
                             {{10, -23, 5}, 2.2f},  {{11, -15, 9}, 2.2f},  {{12, -13, 13}, 2.2f}};
constexpr Point middleCerebral[] = {{{12, -13, 13}, 2},   {{22, -16, 14}, 1.9f}, {{34, -14, 13}, 1.8f},
                                    {{41, -8, 17}, 1.5f}, {{45, 4, 24}, 1.3f},   {{52, 16, 30}, 1.2f},
                                    {{58, 28, 44}, 1},    {{56, 36, 62}, 0.8f}};
constexpr Point middleUpper[] = {{{38, -12, 15}, 1.5f},
                                 {{44, -14, 26}, 1.3f},
                                 {{54, -10, 36}, 1.2f},
                                 {{58, -6, 52}, 1},
                                 {{54, 0, 70}, 0.8f}};
constexpr Point middleLower[] = {
    {{41, -8, 17}, 1.3f}, {{50, -2, 12}, 1.2f}, {{57, 14, 8}, 1}, {{59, 32, 16}, 0.8f}};
constexpr Point anteriorCerebral[] = {{{12, -13, 13}, 1.7f}, {{3, -22, 15}, 1.6f}, {{2, -34, 22}, 1.5f},
                                      {{2, -46, 36}, 1.4f},  {{2, -46, 52}, 1.3f}, {{2, -32, 64}, 1.2f},
                                      {{2, -8, 72}, 1.1f},   {{2, 18, 72}, 1},     {{2, 40, 62}, 0.8f}};
constexpr Point communicating[] = {{{0, -22.5f, 15.5f}, 1.2f}, {{3, -22, 15}, 1.2f}};
constexpr Point posteriorCommunicating[] = {{{11, -14, 11}, 1}, {{9, -4, 9}, 1}, {{7, 3, 8}, 1}};
constexpr Point posteriorCerebral[] = {{{0, 2, 8}, 1.6f},    {{7, 3, 8}, 1.5f},    {{15, 12, 9}, 1.4f},
                                       {{18, 28, 13}, 1.3f}, {{14, 48, 22}, 1.2f}, {{10, 70, 28}, 1}};
constexpr Point basilar[] = {{{0, 14, -32}, 2}, {{0, 8, -16}, 2}, {{0, 3, -2}, 1.9f}, {{0, 2, 8}, 1.8f}};
constexpr Point vertebral[] = {{{19, 20, -150}, 2},   {{19, 20, -62}, 2},    {{31, 31, -52}, 1.9f},
                               {{24, 40, -45}, 1.9f}, {{12, 32, -40}, 1.9f}, {{6, 20, -36}, 1.9f},
                               {{0, 14, -32}, 1.9f}};
constexpr Point superiorCerebellar[] = {
    {{0, 2, 4}, 1}, {{10, 10, 2}, 1}, {{18, 24, 4}, 0.9f}, {{22, 40, 8}, 0.8f}};
constexpr Point external[] = {
    {{29, 0, -110}, 2.4f}, {{36, 2, -84}, 2.2f}, {{45, 6, -56}, 2}, {{55, 6, -32}, 1.6f}};
constexpr Point jugular[] = {
    {{40, 12, -150}, 6}, {{38, 12, -100}, 5.5f}, {{30, 18, -50}, 5}, {{27, 22, -24}, 4.5f}};
constexpr Point transverseSinus[] = {{{0, 90, 16}, 3.5f}, {{22, 85, 12}, 3.5f},  {{44, 67, 6}, 3.5f},
                                     {{54, 44, 2}, 3.5f}, {{50, 32, -10}, 3.5f}, {{38, 28, -22}, 3.5f},
                                     {{27, 22, -24}, 4}};
constexpr Point straightSinus[] = {{{0, 40, 42}, 2}, {{0, 62, 32}, 2.4f}, {{0, 90, 16}, 3}};

// A smooth curve through the points, divided into short tubes, and its bounding box.
class Course {
 public:
  template <std::size_t N>
  explicit Course(const Point (&points)[N]) {
    constexpr int pieces = 4;
    for (std::size_t n = 0; n + 1 < N; ++n)
      for (int piece = 0; piece < pieces; ++piece)
        add(between(points[n > 0 ? n - 1 : 0], points[n], points[n + 1], points[std::min(n + 2, N - 1)],
                    float(piece) / pieces));
    add(points[N - 1]);
  }

  float distance(Vec p, float nearest) const {
    const Vec beyond = glm::max(glm::max(low_ - p, p - high_), Vec(0));
    const float toBox = glm::length(beyond);
    if (toBox > nearest || toBox > 8) return std::min(nearest, std::max(toBox, 1.f));
    for (std::size_t n = 0; n + 1 < points_.size(); ++n)
      nearest = std::min(nearest,
                         tube(p, points_[n].at, points_[n + 1].at, points_[n].radius, points_[n + 1].radius));
    return nearest;
  }

 private:
  // Returns a point of the Catmull-Rom spline from b to c.
  static Point between(Point a, Point b, Point c, Point d, float t) {
    const Vec at = 0.5f * (2.f * b.at + t * (c.at - a.at +
                                             t * (2.f * a.at - 5.f * b.at + 4.f * c.at - d.at +
                                                  t * (3.f * (b.at - c.at) + d.at - a.at))));
    return {at, glm::mix(b.radius, c.radius, t)};
  }
  void add(Point point) {
    points_.push_back(point);
    low_ = glm::min(low_, point.at - point.radius);
    high_ = glm::max(high_, point.at + point.radius);
  }

  std::vector<Point> points_;
  Vec low_{1e6f}, high_{-1e6f};
};

float nearest(Vec p, const std::vector<Course>& courses) {
  float d = 1e3f;
  for (const Course& course : courses) d = course.distance(p, d);
  return d;
}

}  // namespace

float arteries(Vec p) {
  static const std::vector<Course> courses = {Course(carotid),
                                              Course(middleCerebral),
                                              Course(middleUpper),
                                              Course(middleLower),
                                              Course(anteriorCerebral),
                                              Course(communicating),
                                              Course(posteriorCommunicating),
                                              Course(posteriorCerebral),
                                              Course(basilar),
                                              Course(vertebral),
                                              Course(superiorCerebellar),
                                              Course(external)};
  return nearest(mirrored(p), courses);
}

float veins(Vec p, float cavity) {
  static const std::vector<Course> courses = {Course(jugular), Course(transverseSinus),
                                              Course(straightSinus)};
  const float d = nearest(mirrored(p), courses);
  if (p.z < 16 || p.y < -66) return d;
  // The superior sagittal sinus follows the vault in the middle.
  return std::min(d, glm::length(Vec(p.x, cavity + 2.6f, 0)) - 3.2f);
}

}  // namespace volumen::head
