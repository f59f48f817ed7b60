#pragma once

#include "verification/closed_forms/closed_form_formulas.h"

#include <cmath>

namespace irradiff {

// Form factors F12 from a finite area A1 to a finite area A2: the mean over A1 of the form factor of a receiver on it.
// Scalar as in closed_form_formulas.h, and log found by argument-dependent lookup. Pure numbers; one unit of length.

/// Howell C-11: equal rectangles a x b, parallel and directly opposed at distance c.
template <class Scalar>
Scalar opposedRectangles(const Scalar& a, const Scalar& b, const Scalar& c) {
  using std::atan;
  using std::log;
  using std::sqrt;
  const Scalar X = a / c;
  const Scalar Y = b / c;
  const Scalar xx = Scalar(1) + X * X;
  const Scalar yy = Scalar(1) + Y * Y;
  const Scalar root_x = sqrt(xx);
  const Scalar root_y = sqrt(yy);
  const Scalar sum = log(xx * yy / (xx + Y * Y)) / Scalar(2) + X * root_y * atan(X / root_y) +
                     Y * root_x * atan(Y / root_x) - X * atan(X) - Y * atan(Y);
  return Scalar(2) * sum / (piAs<Scalar>() * X * Y);
}

/// Howell C-13 (Ehlert and Smith 1993): from [x0, x1] x [y0, y1] to [xi0, xi1] x [eta0, eta1] in the parallel plane at
/// distance z > 0.
template <class Scalar>
Scalar parallelRectangles(const Scalar& x0, const Scalar& x1, const Scalar& y0, const Scalar& y1, const Scalar& xi0,
                          const Scalar& xi1, const Scalar& eta0, const Scalar& eta1, const Scalar& z) {
  using std::atan;
  using std::log;
  using std::sqrt;
  const auto G = [&z](const Scalar& u, const Scalar& v) {
    const Scalar root_u = sqrt(u * u + z * z);
    const Scalar root_v = sqrt(v * v + z * z);
    return v * root_u * atan(v / root_u) + u * root_v * atan(u / root_v) -
           z * z / Scalar(2) * log(u * u + v * v + z * z);
  };
  const auto over_x = [&](const Scalar& v) {
    return G(x1 - xi1, v) - G(x0 - xi1, v) - G(x1 - xi0, v) + G(x0 - xi0, v);
  };
  const Scalar sum = over_x(y1 - eta1) - over_x(y0 - eta1) - over_x(y1 - eta0) + over_x(y0 - eta0);
  return sum / (Scalar(2) * piAs<Scalar>() * (x1 - x0) * (y1 - y0));
}

/// Rectangles in perpendicular planes (Ehlert and Smith 1993; the case of Howell C-9a and C-9b): from [x0, x1] x [y0,
/// y1] in the plane z = 0 to y in [eta0, eta1], z in [xi0, xi1] in the plane x = 0. Requires x0, xi0 >= 0, x0 + xi0 >
/// 0.
template <class Scalar>
Scalar perpendicularRectangles(const Scalar& x0, const Scalar& x1, const Scalar& y0, const Scalar& y1,
                               const Scalar& xi0, const Scalar& xi1, const Scalar& eta0, const Scalar& eta1) {
  using std::atan;
  using std::log;
  using std::sqrt;
  const auto G = [](const Scalar& x, const Scalar& v, const Scalar& xi) {
    const Scalar square = x * x + xi * xi;
    const Scalar root = sqrt(square);
    const Scalar K = v / root;
    return v * root * atan(K) - square * (Scalar(1) - K * K) * log(square * (Scalar(1) + K * K)) / Scalar(4);
  };
  const auto over_planes = [&](const Scalar& v) {
    return G(x1, v, xi1) - G(x0, v, xi1) - G(x1, v, xi0) + G(x0, v, xi0);
  };
  const Scalar sum = over_planes(y1 - eta1) - over_planes(y0 - eta1) - over_planes(y1 - eta0) + over_planes(y0 - eta0);
  return sum / (Scalar(2) * piAs<Scalar>() * (x1 - x0) * (y1 - y0));
}

/// Howell C-14: from a rectangle w x l to a rectangle h x l at a right angle to it with the common edge l.
template <class Scalar>
Scalar perpendicularRectanglesWithCommonEdge(const Scalar& h, const Scalar& l, const Scalar& w) {
  using std::atan;
  using std::log;
  using std::sqrt;
  const Scalar H = h / l;
  const Scalar W = w / l;
  const Scalar hh = H * H;
  const Scalar ww = W * W;
  const Scalar root = sqrt(hh + ww);
  const Scalar all = Scalar(1) + hh + ww;
  const Scalar logs = log((Scalar(1) + ww) * (Scalar(1) + hh) / all) +
                      ww * log(ww * all / ((Scalar(1) + ww) * (hh + ww))) +
                      hh * log(hh * all / ((Scalar(1) + hh) * (hh + ww)));
  const Scalar angles = W * atan(Scalar(1) / W) + H * atan(Scalar(1) / H) - root * atan(Scalar(1) / root);
  return (angles + logs / Scalar(4)) / (piAs<Scalar>() * W);
}

/// Howell C-1: two directly opposed plates without end, both w wide, at distance h.
template <class Scalar>
Scalar opposedInfinitePlates(const Scalar& w, const Scalar& h) {
  using std::sqrt;
  const Scalar H = h / w;
  return sqrt(Scalar(1) + H * H) - H;
}

/// Howell C-5a: from a plate without end, a wide, to one with a common edge that rises from it by the vector (p, q), q
/// > 0, that is b = |(p, q)| wide at the angle alpha with cos alpha = p/b (crossed strings, Hottel 1954).
template <class Scalar>
Scalar infinitePlatesWithCommonEdge(const Scalar& a, const Scalar& p, const Scalar& q) {
  using std::sqrt;
  const Scalar b = sqrt(p * p + q * q);
  const Scalar A = a / b;
  return (A + Scalar(1) - sqrt(A * A + Scalar(1) - Scalar(2) * A * p / b)) / (Scalar(2) * A);
}

/// Modest D-33: from a plate without end, w wide, to one h wide at a right angle to it, with a common edge.
template <class Scalar>
Scalar perpendicularInfinitePlates(const Scalar& h, const Scalar& w) {
  using std::sqrt;
  const Scalar H = h / w;
  return (Scalar(1) + H - sqrt(Scalar(1) + H * H)) / Scalar(2);
}

}  // namespace irradiff
