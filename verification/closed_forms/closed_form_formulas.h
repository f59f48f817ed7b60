#pragma once

#include <array>
#include <cmath>

namespace irradiff {

// Form factors from a receiver (a differential element dA1 with unit normal n) to a polygon, as printed in catalogues
// or derived in docs/closed_forms.md. Every length is in the same unit, every result is a pure number, F = E / (pi L).
//
// Scalar is a floating type, a multiprecision number or a dual number: arithmetic, sqrt, atan, sin and cos found by
// argument-dependent lookup, construction from int. No branches. At double the sums cancel for small or distant
// polygons, so a reference value is taken at 100 digits, where nothing in the ranges of closedForms() comes near to
// mattering.
//
// Capital letters and X, Y, Z, K, G inside the bodies are those of the formula cited.

/// pi at the precision of Scalar.
template <class Scalar>
Scalar piAs() {
  using std::atan;
  return Scalar(4) * atan(Scalar(1));
}

/// Howell B-3: rectangle a x b parallel to the element at distance c, whose corner lies on the element's normal.
/// Odd in a and in b, which is what makes superposition work. Requires c > 0.
template <class Scalar>
Scalar parallelRectangleAtCorner(const Scalar& a, const Scalar& b, const Scalar& c) {
  using std::atan;
  using std::sqrt;
  const Scalar A = a / c;
  const Scalar B = b / c;
  const Scalar root_a = sqrt(Scalar(1) + A * A);
  const Scalar root_b = sqrt(Scalar(1) + B * B);
  return (A / root_a * atan(B / root_a) + B / root_b * atan(A / root_b)) / (Scalar(2) * piAs<Scalar>());
}

/// Howell B-4: rectangle in a plane perpendicular to that of the element and at distance c from it, reaching a above
/// the element's plane and b sideways from the foot of the perpendicular. Even in a, odd in b. Requires c > 0.
template <class Scalar>
Scalar perpendicularRectangleAtCorner(const Scalar& a, const Scalar& b, const Scalar& c) {
  using std::atan;
  using std::sqrt;
  const Scalar d = sqrt(a * a + c * c);
  return (atan(b / c) - c / d * atan(b / d)) / (Scalar(2) * piAs<Scalar>());
}

/// B-3 by configuration factor algebra: the rectangle [x0, x1] x [y0, y1] at height h over the plane of the element,
/// which lies at the origin with normal +z. Requires h > 0; x0 <= x1, y0 <= y1 for a positive result.
template <class Scalar>
Scalar parallelRectangle(const Scalar& x0, const Scalar& x1, const Scalar& y0, const Scalar& y1, const Scalar& h) {
  return parallelRectangleAtCorner(x1, y1, h) - parallelRectangleAtCorner(x0, y1, h) -
         parallelRectangleAtCorner(x1, y0, h) + parallelRectangleAtCorner(x0, y0, h);
}

/// B-4 by configuration factor algebra: the rectangle [x0, x1] x [y0, y1] in the plane z = h, seen by an element at the
/// origin with normal +x. Requires h > 0 and x0 >= 0 (nothing below the element's horizon).
template <class Scalar>
Scalar perpendicularRectangle(const Scalar& x0, const Scalar& x1, const Scalar& y0, const Scalar& y1, const Scalar& h) {
  return perpendicularRectangleAtCorner(x1, y1, h) - perpendicularRectangleAtCorner(x0, y1, h) -
         perpendicularRectangleAtCorner(x1, y0, h) + perpendicularRectangleAtCorner(x0, y0, h);
}

/// The vector V with F = n.V for every unit normal n that has the whole rectangle [x0, x1] x [y0, y1] x {h} above its
/// horizon; the element lies at the origin, h > 0. Its components are B-4, B-4 and B-3. Shape: 3.
/// Moving the element by (dx, dy, dz) is shifting the five arguments by its negative, so differences of this closed
/// form at 100 digits are a gradient and a Hessian that owe nothing to any differentiated formula.
template <class Scalar>
std::array<Scalar, 3> rectangleVectorFormFactor(const Scalar& x0, const Scalar& x1, const Scalar& y0, const Scalar& y1,
                                                const Scalar& h) {
  return {perpendicularRectangle(x0, x1, y0, y1, h), perpendicularRectangle(y0, y1, x0, x1, h),
          parallelRectangle(x0, x1, y0, y1, h)};
}

/// Howell B-6: a rectangle, b wide along the line where its plane meets the element's plane, reaching from there by
/// the vector (p, q), q > 0, that is a = |(p, q)| at the angle Phi with cos Phi = p/a, sin Phi = q/a; the element lies
/// at distance c from that line, opposite the end y = 0. On the far side sits a right triangle with its vertex at y =
/// 0, so that the far side is a + b tan Theta away at y = b; `k` is tan Theta > -a/b (negative: the side recedes).
template <class Scalar>
Scalar tiltedRectangleWithTriangle(const Scalar& p, const Scalar& q, const Scalar& b, const Scalar& c,
                                   const Scalar& k) {
  using std::atan;
  using std::sqrt;
  const Scalar a = sqrt(p * p + q * q);
  const Scalar cos_phi = p / a;
  const Scalar sin_phi = q / a;
  const Scalar A = a / b;
  const Scalar C = c / b;
  const Scalar Z = A - C * cos_phi;
  const Scalar X = sqrt((k * k + Scalar(1)) * C * C * sin_phi * sin_phi + Z * Z);
  const Scalar Y = sqrt(Scalar(1) + C * C * sin_phi * sin_phi);
  const Scalar far_side = (A * cos_phi - C) / X * (atan((k * Z + Scalar(1) + k * k) / X) - atan(k * Z / X));
  const Scalar side = cos_phi / Y * (atan((Z + k) / Y) + atan(C * cos_phi / Y));
  return (atan(Scalar(1) / C) + far_side + side) / (Scalar(2) * piAs<Scalar>());
}

/// Howell B-8: the rectangle of tiltedRectangleWithTriangle without the triangle.
template <class Scalar>
Scalar tiltedRectangle(const Scalar& p, const Scalar& q, const Scalar& b, const Scalar& c) {
  using std::atan;
  using std::sqrt;
  const Scalar a = sqrt(p * p + q * q);
  const Scalar cos_phi = p / a;
  const Scalar sin_phi = q / a;
  const Scalar A = a / b;
  const Scalar C = c / b;
  const Scalar X = Scalar(1) / sqrt(A * A + C * C - Scalar(2) * A * C * cos_phi);
  const Scalar Y = sqrt(Scalar(1) + C * C * sin_phi * sin_phi);
  return (atan(Scalar(1) / C) + (A * cos_phi - C) * X * atan(X) +
          cos_phi / Y * (atan((A - C * cos_phi) / Y) + atan(C * cos_phi / Y))) /
         (Scalar(2) * piAs<Scalar>());
}

/// Triangle (0,0), (a,0), (p,q), q > 0, in the plane at height h parallel to the element, with its first vertex on the
/// element's normal. Only the opposite edge contributes; docs/closed_forms.md.
template <class Scalar>
Scalar parallelTriangleAtVertex(const Scalar& a, const Scalar& p, const Scalar& q, const Scalar& h) {
  using std::atan;
  using std::sqrt;
  const Scalar edge = sqrt((p - a) * (p - a) + q * q);
  const Scalar d = a * q / edge;
  const Scalar root = sqrt(h * h + d * d);
  const Scalar t0 = a * (p - a) / edge;
  return d / root * (atan((t0 + edge) / root) - atan(t0 / root)) / (Scalar(2) * piAs<Scalar>());
}

/// Right triangle standing on the element's plane at distance c: its right angle at the foot of the element's
/// perpendicular, b wide along the element's plane, a high. Derived in docs/closed_forms.md.
template <class Scalar>
Scalar standingRightTriangle(const Scalar& a, const Scalar& b, const Scalar& c) {
  using std::atan;
  using std::sqrt;
  const Scalar root = sqrt(a * a * b * b + a * a * c * c + b * b * c * c);
  return (atan(b / c) - b * c / root * atan(root / (c * c))) / (Scalar(2) * piAs<Scalar>());
}

/// Regular polygon with n sides and circumradius r, parallel to the element at distance h, its centre on the element's
/// normal: 2 n right triangles of parallelTriangleAtVertex.
template <class Scalar>
Scalar regularPolygonOnAxis(const Scalar& n, const Scalar& r, const Scalar& h) {
  using std::atan;
  using std::cos;
  using std::sin;
  using std::sqrt;
  const Scalar half_angle = piAs<Scalar>() / n;
  const Scalar inradius = r * cos(half_angle);
  const Scalar root = sqrt(h * h + inradius * inradius);
  return n / piAs<Scalar>() * inradius / root * atan(r * sin(half_angle) / root);
}

/// Howell B-71 / Modest D-24, (sin phi2 - sin phi1)/2: a strip without end along y that meets the plane y = 0 in the
/// segment from (x0, z0) to (x1, z1), seen by an element at the origin with normal +z. Requires z0, z1 >= 0 and the
/// second point clockwise of the first.
template <class Scalar>
Scalar infiniteStrip(const Scalar& x0, const Scalar& z0, const Scalar& x1, const Scalar& z1) {
  using std::sqrt;
  return (x1 / sqrt(x1 * x1 + z1 * z1) - x0 / sqrt(x0 * x0 + z0 * z0)) / Scalar(2);
}

/// Modest D-23: a strip without end that rises from a line in the element's plane, at distance c from the element, by
/// the vector (p, q), q > 0 (p > 0 leans over the element): L = |(p, q)|, cos Phi = p/L.
template <class Scalar>
Scalar infiniteTiltedStrip(const Scalar& p, const Scalar& q, const Scalar& c) {
  using std::sqrt;
  const Scalar length = sqrt(p * p + q * q);
  const Scalar X = c / length;
  const Scalar cos_phi = p / length;
  return (Scalar(1) + (cos_phi - X) / sqrt(Scalar(1) + X * X - Scalar(2) * X * cos_phi)) / Scalar(2);
}

}  // namespace irradiff
