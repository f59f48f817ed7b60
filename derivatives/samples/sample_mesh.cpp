#include "derivatives/samples/sample_mesh.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace irradiff {

namespace {

using Row = std::vector<std::size_t>;

Row consecutive(std::size_t first, std::size_t count) {
  Row row(count);
  std::iota(row.begin(), row.end(), first);
  return row;
}

void append(Row& row, const Row& more) { row.insert(row.end(), more.begin(), more.end()); }

}  // namespace

SampleMesh::SampleMesh(Stratification stratification, GridShape shape, MeshRim rim) : sample_count_(shape.size()) {
  switch (stratification) {
    case Stratification::kConcentric:
      if (shape.rows >= 2 && shape.columns >= 2) addRim(addConcentric(shape), rim);
      break;
    case Stratification::kPolar:
      if (shape.rows >= 1 && shape.columns >= 4) addRim(addPolar(shape), rim);
      break;
    case Stratification::kHemicube:
      addRim(addHemicube(shape.columns), rim);
      break;
  }
}

std::size_t SampleMesh::addTriangle(std::size_t a, std::size_t b, std::size_t c) {
  const std::size_t number = triangle_count_++;
  if (!triangles_.empty()) {
    MeshTriangles& last = triangles_.back();
    if (a == last.corners[0] + last.count && b == last.corners[1] + last.count && c == last.corners[2] + last.count) {
      ++last.count;
      return number;
    }
  }
  triangles_.push_back({number, {a, b, c}, 1});
  return number;
}

void SampleMesh::addEdge(std::vector<MeshEdges>& edges, std::size_t start, std::size_t end, std::size_t right,
                         std::size_t left) {
  if (!edges.empty()) {
    MeshEdges& last = edges.back();
    if (start == last.start + last.count && end == last.end + last.count && right == last.right + last.count &&
        left == last.left + last.count) {
      ++last.count;
      return;
    }
  }
  edges.push_back({start, end, right, left, 1});
}

void SampleMesh::addRow(std::vector<MeshEdges>& edges, const Row& row, const Row& right, const Row& left) {
  for (std::size_t k = 0; k < right.size(); ++k) {
    addEdge(edges, row[k], row[(k + 1) % row.size()], right[k], left[k]);
  }
}

SampleMesh::Strip SampleMesh::addStrip(const Row& a, const Row& b, bool wraps) {
  const std::size_t cells = wraps ? a.size() : a.size() - 1;
  const auto next = [&a](std::size_t k) { return (k + 1) % a.size(); };
  Strip strip;
  for (std::size_t k = 0; k < cells; ++k) strip.lower.push_back(addTriangle(a[k], a[next(k)], b[next(k)]));
  for (std::size_t k = 0; k < cells; ++k) strip.upper.push_back(addTriangle(a[k], b[next(k)], b[k]));
  for (std::size_t k = 0; k < cells; ++k) addEdge(edges_, a[k], b[next(k)], strip.upper[k], strip.lower[k]);
  for (std::size_t k = 1; k < cells; ++k) addEdge(edges_, a[k], b[k], strip.lower[k - 1], strip.upper[k]);
  if (wraps) addEdge(edges_, a[0], b[0], strip.lower[cells - 1], strip.upper[0]);
  return strip;
}

std::vector<SampleMesh::Strip> SampleMesh::addStrips(const std::vector<Row>& rows, bool wraps) {
  std::vector<Strip> strips;
  for (std::size_t r = 0; r + 1 < rows.size(); ++r) {
    strips.push_back(addStrip(rows[r], rows[r + 1], wraps));
    if (r > 0) addRow(edges_, rows[r], strips[r].lower, strips[r - 1].upper);
  }
  return strips;
}

SampleMesh::Ring SampleMesh::closeAbove(const std::vector<Row>& rows, const std::vector<Strip>& strips,
                                        const Row& above) {
  if (strips.empty()) return {rows.front(), above};
  addRow(edges_, rows.back(), above, strips.back().upper);
  return {rows.front(), strips.front().lower};
}

std::array<SampleMesh::Ring, 4> SampleMesh::addGrid(std::size_t first_vertex, std::size_t rows, std::size_t columns) {
  std::vector<Row> vertices;
  for (std::size_t r = 0; r < rows; ++r) vertices.push_back(consecutive(first_vertex + r * columns, columns));
  const std::vector<Strip> strips = addStrips(vertices, false);
  std::array<Ring, 4> sides;
  for (std::size_t r = 0; r + 1 < rows; ++r) {
    sides[0].vertices.push_back(vertices[r].back());
    sides[0].triangles.push_back(strips[r].lower.back());
    const std::size_t down = rows - 1 - r;
    sides[2].vertices.push_back(vertices[down].front());
    sides[2].triangles.push_back(strips[down - 1].upper.front());
  }
  for (std::size_t k = 0; k + 1 < columns; ++k) {
    const std::size_t back = columns - 1 - k;
    sides[1].vertices.push_back(vertices.back()[back]);
    sides[1].triangles.push_back(strips.back().upper[back - 1]);
    sides[3].vertices.push_back(vertices.front()[k]);
    sides[3].triangles.push_back(strips.front().lower[k]);
  }
  return sides;
}

SampleMesh::Ring SampleMesh::addConcentric(GridShape shape) {
  Ring ring;
  for (const Ring& side : addGrid(0, shape.rows, shape.columns)) {
    append(ring.vertices, side.vertices);
    append(ring.triangles, side.triangles);
  }
  return ring;
}

SampleMesh::Ring SampleMesh::addPolar(GridShape shape) {
  const std::size_t columns = shape.columns;
  std::vector<Row> rings;
  for (std::size_t r = shape.rows; r-- > 0;) rings.push_back(consecutive(r * columns, columns));
  const std::vector<Strip> strips = addStrips(rings, true);
  Row fan;
  for (std::size_t k = 1; k + 1 < columns; ++k) {
    fan.push_back(addTriangle(0, k, k + 1));
    if (k > 1) addEdge(edges_, 0, k, fan[k - 1], fan[k - 2]);
  }
  Row above{fan.front()};
  append(above, fan);
  above.push_back(fan.back());
  return closeAbove(rings, strips, above);
}

SampleMesh::Ring SampleMesh::addHemicube(std::size_t resolution) {
  const std::size_t face_rows = resolution / 2;
  const auto faceRow = [&](std::size_t face, std::size_t row) {
    return consecutive((resolution + face * face_rows + row) * resolution, resolution);
  };
  std::vector<Row> band(face_rows);
  for (std::size_t r = 0; r < face_rows; ++r) {
    for (std::size_t face = 0; face < 4; ++face) append(band[r], faceRow(face, r));
  }
  const std::vector<Strip> strips = addStrips(band, true);
  const std::array<Ring, 4> top = addGrid(0, resolution, resolution);

  std::array<Strip, 4> stitches;
  std::array<std::size_t, 4> corners{};
  Row above;
  for (std::size_t face = 0; face < 4; ++face) {
    const Row outer = faceRow(face, face_rows - 1);
    const std::size_t next = (face + 1) % 4;
    Row inner = top[face].vertices;
    inner.push_back(top[next].vertices.front());
    stitches[face] = addStrip(outer, inner, false);
    addRow(edges_, inner, top[face].triangles, stitches[face].upper);
    corners[face] = addTriangle(outer.back(), faceRow(next, face_rows - 1).front(), inner.back());
    append(above, stitches[face].lower);
    above.push_back(corners[face]);
  }
  for (std::size_t face = 0; face < 4; ++face) {
    // The sides of a corner's triangle, each from the half face to the corner of the top face.
    const std::size_t next = (face + 1) % 4;
    const std::size_t corner = top[next].vertices.front();
    addEdge(edges_, faceRow(face, face_rows - 1).back(), corner, stitches[face].lower.back(), corners[face]);
    addEdge(edges_, faceRow(next, face_rows - 1).front(), corner, corners[face], stitches[next].upper.front());
  }
  return closeAbove(band, strips, above);
}

void SampleMesh::addRim(const Ring& ring, MeshRim rim) {
  outermost_samples_ = ring.vertices;
  if (rim == MeshRim::kOpen) {
    addRow(edges_, ring.vertices, ring.triangles, Row(ring.vertices.size(), outside()));
    return;
  }
  const Row horizon = consecutive(sample_count_, ring.vertices.size());
  const Strip strip = addStrip(horizon, ring.vertices, true);
  addRow(edges_, ring.vertices, ring.triangles, strip.upper);
  addRow(horizon_edges_, horizon, strip.lower, Row(horizon.size(), outside()));
}

}  // namespace irradiff
