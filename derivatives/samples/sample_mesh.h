#pragma once

#include "derivatives/samples/stratification.h"

#include <array>
#include <cstddef>
#include <vector>

namespace irradiff {

/// Triangles first, first + 1, ... whose corners are numbered consecutively too. Counterclockwise seen from above the
/// receiver, which is clockwise seen from it: w0.(w1 x w2) > 0 for samples at the centres of their strata.
struct MeshTriangles {
  std::size_t first = 0;
  std::array<std::size_t, 3> corners;  ///< vertices of the first triangle
  std::size_t count = 0;
};

/// Edges whose ends and triangles are numbered consecutively: those of edge k are each k more than these. Right and
/// left are seen from the receiver, travelling from start to end.
struct MeshEdges {
  std::size_t start = 0, end = 0;   ///< vertices
  std::size_t right = 0, left = 0;  ///< triangles, or SampleMesh::outside()
  std::size_t count = 0;
};

enum class MeshRim {
  kOpen,           ///< the mesh ends at the outermost samples
  kDownToHorizon,  ///< each outermost sample is joined to a vertex on the horizon
};

/// The triangles over the samples of a hemisphere that the neighbourhood of their strata gives, and the edges between
/// them. Depends on stratification and shape alone; takes little memory, since what runs along rows is listed once.
///
/// Between two rows of strata (concentric: from row to row; polar: from a ring inward; hemicube: upward on the half
/// faces) with samples a_k and b_k, the quadrilateral a_k, a_(k+1), b_(k+1), b_k is two triangles with the diagonal
/// from a_k to b_(k+1). Polar: columns wrap around, and a fan from the first sample of the innermost ring closes the
/// pole. Hemicube: the half faces wrap around, the outermost texels of the top face are the row above them, and at the
/// cube's corners three texels make a triangle. Between the samples and the vertices on the horizon likewise.
class SampleMesh {
 public:
  /// Has no triangles where neighbours need not span any: fewer than 2 rows or columns of concentric strata, fewer than
  /// 4 columns of polar ones, where two neighbours may be more than half a turn apart. Requires a shape that Strata
  /// accepts.
  SampleMesh(Stratification stratification, GridShape shape, MeshRim rim);

  bool isEmpty() const { return triangle_count_ == 0; }
  /// Vertices 0 .. sampleCount() - 1 are the samples; sampleCount() + k is the vertex on the horizon of
  /// outermostSamples()[k].
  std::size_t sampleCount() const { return sample_count_; }
  std::size_t triangleCount() const { return triangle_count_; }
  /// Counterclockwise seen from above.
  const std::vector<std::size_t>& outermostSamples() const { return outermost_samples_; }
  const std::vector<MeshTriangles>& triangles() const { return triangles_; }
  /// All but those between vertices on the horizon.
  const std::vector<MeshEdges>& edges() const { return edges_; }
  /// They add nothing to derivatives.
  const std::vector<MeshEdges>& horizonEdges() const { return horizon_edges_; }
  /// In place of a triangle: there is none, its radiance is 0.
  std::size_t outside() const { return triangle_count_; }

 private:
  using Row = std::vector<std::size_t>;  ///< numbers of vertices or of triangles
  struct Strip {
    Row lower;  ///< triangles a_k, a_(k+1), b_(k+1)
    Row upper;  ///< triangles a_k, b_(k+1), b_k
  };
  /// A closed line of edges with the triangles on their right; on their left there is nothing yet.
  struct Ring {
    Row vertices;
    Row triangles;
  };

  std::size_t addTriangle(std::size_t a, std::size_t b, std::size_t c);
  void addEdge(std::vector<MeshEdges>& edges, std::size_t start, std::size_t end, std::size_t right, std::size_t left);
  /// As many edges from one vertex of `row` to the next as there are triangles.
  void addRow(std::vector<MeshEdges>& edges, const Row& row, const Row& right, const Row& left);
  /// The triangles between two rows and the edges inside the strip: as many cells as rows have vertices if they wrap
  /// around, else one less.
  Strip addStrip(const Row& a, const Row& b, bool wraps);
  /// The strips between all rows and the edges of the rows between them.
  std::vector<Strip> addStrips(const std::vector<Row>& rows, bool wraps);
  /// The edges of the last of `rows`, which wrap around, with the triangles above it. Returns the outer ring.
  Ring closeAbove(const std::vector<Row>& rows, const std::vector<Strip>& strips, const Row& above);
  /// A grid whose rows do not wrap around. Its sides in the order of the hemicube's half faces: +t, +b, -t, -b.
  std::array<Ring, 4> addGrid(std::size_t first_vertex, std::size_t rows, std::size_t columns);

  Ring addConcentric(GridShape shape);
  Ring addPolar(GridShape shape);
  Ring addHemicube(std::size_t resolution);
  void addRim(const Ring& ring, MeshRim rim);

  std::size_t sample_count_ = 0;
  std::size_t triangle_count_ = 0;
  std::vector<std::size_t> outermost_samples_;
  std::vector<MeshTriangles> triangles_;
  std::vector<MeshEdges> edges_;
  std::vector<MeshEdges> horizon_edges_;
};

}  // namespace irradiff
