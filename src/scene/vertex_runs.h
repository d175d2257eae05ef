// Where vertices lie, in double precision: boxes around runs of vertices that follow one another in a file,
// which mostly belong together.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include <glm/glm.hpp>

namespace lavalight {

struct VertexRun {
    glm::dvec3 lower{std::numeric_limits<double>::infinity()};
    glm::dvec3 upper{-std::numeric_limits<double>::infinity()};
    size_t mesh = 0; // the file's number of the mesh that they are of

    // Length of the longest side; negative for a run of no vertices.
    [[nodiscard]] double size() const {
        const glm::dvec3 sides = upper - lower;
        return std::max({sides.x, sides.y, sides.z});
    }
    // Largest coordinate of any corner, without its sign.
    [[nodiscard]] double reach() const {
        const glm::dvec3 far = glm::max(glm::abs(lower), glm::abs(upper));
        return std::max({far.x, far.y, far.z});
    }
    // Distance from a point, along the axis where it is largest; 0 inside.
    [[nodiscard]] double distance(const glm::dvec3& point) const {
        const glm::dvec3 gaps = glm::max(lower - point, point - upper);
        return std::max({gaps.x, gaps.y, gaps.z, 0.0});
    }
};

class VertexRuns {
  public:
    // The vertices that follow are those of an instance of the file's mesh of that number.
    void begin(size_t mesh, size_t vertices);
    // Positions that no mesh may have are passed over.
    void add(const glm::dvec3& position);

    [[nodiscard]] const std::vector<VertexRun>& all() const { return runs_; }

  private:
    [[nodiscard]] bool belongs(const glm::dvec3& position) const;

    std::vector<VertexRun> runs_;
    size_t mesh_ = 0;
    size_t left_ = 0;   // vertices of the instance that are still to come
    size_t length_ = 0; // vertices of the last run; 0: the next vertex starts another
};

} // namespace lavalight
