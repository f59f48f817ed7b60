#include "derivatives/flatland/half_circle.h"

#include "derivatives/scene/certified_sign.h"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace irradiff {
namespace {

using Eigen::Vector2d;

template <class Number>
Number crossProduct(const Vector2<Number>& a, const Vector2<Number>& b) {
  return a(0) * b(1) - a(1) * b(0);
}

template <class Number>
Vector2<Number> lifted(const Vector2d& position) {
  return {Number(position.x()), Number(position.y())};
}

/// From a to b.
template <class Number>
Vector2<Number> vectorBetween(const Vector2d& a, const Vector2d& b) {
  return {Number(b.x()) - Number(a.x()), Number(b.y()) - Number(a.y())};
}

template <class Number>
Vector2<Number> edgeOf(const FlatlandSource& s) {
  return vectorBetween<Number>(s.first, s.last);
}

}  // namespace

HalfCircle::HalfCircle(std::span<const Segment> segments, std::span<const std::size_t> considered,
                       const FlatlandReceiver& receiver)
    : segments_(segments), receiver_(receiver) {
  for (const std::size_t index : considered) addSource(index, considered.size() < segments.size());
}

double HalfCircle::radiance(std::size_t source) const {
  return source == kNobody ? 0.0 : segments_[sources_[source].index].radiance;
}

std::string HalfCircle::nameOf(std::size_t source) const {
  const std::size_t index = sources_[source].index;
  return "segments[" + std::to_string(index) + "] \"" + segments_[index].name + '"';
}

template <class Number>
Vector2<Number> HalfCircle::relative(const Vector2d& p) const {
  return vectorBetween<Number>(receiver_.position, p);
}

template <class Number>
HalfCircle::Line<Number> HalfCircle::line(std::size_t source) const {
  const FlatlandSource& s = sources_[source];
  const Vector2<Number> e = edgeOf<Number>(s);
  return {{e(1), -e(0)}, crossProduct(relative<Number>(s.first), e)};
}

template <class Number>
Vector2<Number> HalfCircle::alongCrossing(const FlatlandDirection& d) const {
  // Where both lines are equally far: normal to the difference of normal/offset, on the side of the crossing.
  const Line<Number> a = line<Number>(d.source);
  const Line<Number> b = line<Number>(d.other);
  const Vector2<Number> inverse = difference(scaled(a.normal, b.offset), scaled(b.normal, a.offset));
  return d.turn > 0 ? Vector2<Number>{-inverse(1), inverse(0)} : Vector2<Number>{inverse(1), -inverse(0)};
}

template <class Number>
Vector2<Number> HalfCircle::along(const FlatlandDirection& d) const {
  if (d.kind == FlatlandDirection::Kind::kEnd) return relative<Number>(endOf(d));
  if (d.kind == FlatlandDirection::Kind::kCrossing) return alongCrossing<Number>(d);
  const Vector2<Number> n = lifted<Number>(receiver_.normal);
  return d.kind == FlatlandDirection::Kind::kStart ? Vector2<Number>{n(1), -n(0)} : Vector2<Number>{-n(1), n(0)};
}

int HalfCircle::turn(std::size_t a, std::size_t b) const {
  return certifiedSign([&]<class Number>(std::type_identity<Number>) {
    return crossProduct(edgeOf<Number>(sources_[a]), edgeOf<Number>(sources_[b]));
  });
}

int HalfCircle::compare(const FlatlandDirection& a, const FlatlandDirection& b) const {
  using Kind = FlatlandDirection::Kind;
  if (a.kind == Kind::kStart || b.kind == Kind::kStop) return a.kind == b.kind ? 0 : -1;
  if (a.kind == Kind::kStop || b.kind == Kind::kStart) return 1;
  if (a.kind == Kind::kEnd && b.kind == Kind::kEnd && endOf(a) == endOf(b)) return 0;
  return -certifiedSign(
      [&]<class Number>(std::type_identity<Number>) { return crossProduct(along<Number>(a), along<Number>(b)); });
}

int HalfCircle::side(const FlatlandDirection& d, const Vector2d& p) const {
  if (d.kind == FlatlandDirection::Kind::kEnd && endOf(d) == p) return 0;
  return certifiedSign(
      [&]<class Number>(std::type_identity<Number>) { return crossProduct(along<Number>(d), relative<Number>(p)); });
}

int HalfCircle::before(std::size_t source, const Vector2d& p) const {
  return certifiedSign([&]<class Number>(std::type_identity<Number>) {
    const Line<Number> a = line<Number>(source);
    return a.offset - dot(a.normal, relative<Number>(p));
  });
}

int HalfCircle::nearer(std::size_t a, std::size_t b, const FlatlandDirection& d) const {
  if (d.kind == FlatlandDirection::Kind::kEnd && d.source == a) return before(b, endOf(d));
  if (d.kind == FlatlandDirection::Kind::kEnd && d.source == b) return -before(a, endOf(d));
  if (d.kind == FlatlandDirection::Kind::kCrossing && std::minmax(a, b) == std::minmax(d.source, d.other)) return 0;
  return certifiedSign([&]<class Number>(std::type_identity<Number>) {
    const Vector2<Number> w = along<Number>(d);
    const Line<Number> line_a = line<Number>(a);
    const Line<Number> line_b = line<Number>(b);
    return dot(line_a.normal, w) * line_b.offset - dot(line_b.normal, w) * line_a.offset;
  });
}

void HalfCircle::addSource(std::size_t index, bool is_on_surface) {
  const auto height = [&](const Vector2d& p) {
    return certifiedSign([&]<class Number>(std::type_identity<Number>) {
      return dot(lifted<Number>(receiver_.normal), relative<Number>(p));
    });
  };
  const Vector2d& a = segments_[index].vertices[0];
  const Vector2d& b = segments_[index].vertices[1];
  FlatlandSource s{index, a, b, 0, height(a), height(b), false, false, {}, {}};
  s.rises = s.first_height > 0 || s.last_height > 0;
  const bool touches = s.first_height == 0 || s.last_height == 0;
  // A receiver on a surface does not leave it to the side on which it would see what only touches its horizon.
  if (!s.rises && (!touches || is_on_surface)) return;
  const int orientation = certifiedSign(
      [&]<class Number>(std::type_identity<Number>) { return crossProduct(relative<Number>(a), edgeOf<Number>(s)); });
  if (orientation < 0) {
    std::swap(s.first, s.last);
    std::swap(s.first_height, s.last_height);
    s.first_end = 1;
  }
  const std::size_t source = sources_.size();
  s.is_end_on = orientation == 0;
  s.start = s.first_height > 0 ? FlatlandDirection{FlatlandDirection::Kind::kEnd, source, false} : kHorizonStart;
  s.stop = s.last_height > 0 ? FlatlandDirection{FlatlandDirection::Kind::kEnd, source, true} : kHorizonStop;
  sources_.push_back(s);
}

int HalfCircle::ahead(const FlatlandDirection& d, const Vector2d& p) const {
  return certifiedSign(
      [&]<class Number>(std::type_identity<Number>) { return dot(along<Number>(d), relative<Number>(p)); });
}

bool HalfCircle::isNearer(const Vector2d& a, const Vector2d& b) const {
  return a != b && certifiedSign([&]<class Number>(std::type_identity<Number>) {
                     return dot(relative<Number>(a), difference(relative<Number>(b), relative<Number>(a)));
                   }) > 0;
}

bool HalfCircle::onOneLine(std::size_t a, std::size_t b) const {
  return before(a, sources_[b].first) == 0 && before(a, sources_[b].last) == 0;
}

}  // namespace irradiff
