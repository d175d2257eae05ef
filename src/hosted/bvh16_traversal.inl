// The traversal of a Bvh16, for vectors of LANES floats and the processors that LAVALIGHT_TARGET names:
// included once for each, within a namespace.

using Floats = float __attribute__((vector_size(4 * LANES)));
using Ints = int32_t __attribute__((vector_size(4 * LANES)));

template <size_t kLanes>
LAVALIGHT_TARGET inline Floats load(const std::array<float, kLanes>& floats, uint32_t part) {
    Floats lanes;
    std::memcpy(&lanes, floats.data() + part * LANES, sizeof lanes);
    return lanes;
}

template <size_t kLanes>
LAVALIGHT_TARGET inline Ints load(const std::array<uint32_t, kLanes>& words, uint32_t part) {
    Ints lanes;
    std::memcpy(&lanes, words.data() + part * LANES, sizeof lanes);
    return lanes;
}

template <size_t kLanes>
LAVALIGHT_TARGET inline void store(std::array<float, kLanes>& floats, uint32_t part, Floats lanes) {
    std::memcpy(floats.data() + part * LANES, &lanes, sizeof lanes);
}

// These take numbers of one ray, or of several rays side by side.
LAVALIGHT_TARGET inline Floats larger(Floats a, Floats b) {
    return a > b ? a : b;
}

inline float larger(float a, float b) {
    return a > b ? a : b;
}

LAVALIGHT_TARGET inline Floats smaller(Floats a, Floats b) {
    return a < b ? a : b;
}

LAVALIGHT_TARGET inline Floats magnitude(Floats lanes) {
    return reinterpret_cast<Floats>(reinterpret_cast<Ints>(lanes) & 0x7fffffff);
}

inline float magnitude(float number) {
    return std::abs(number);
}

// The first number must not be negative.
LAVALIGHT_TARGET inline Floats withSignOf(Floats lanes, Floats sign) {
    return reinterpret_cast<Floats>(reinterpret_cast<Ints>(lanes) |
                                    (reinterpret_cast<Ints>(sign) & std::numeric_limits<int32_t>::min()));
}

inline float withSignOf(float number, float sign) {
    return std::copysign(number, sign);
}

// What boxes and triangles are tested with, for one ray or rays side by side.
template <typename Real>
struct RaySetup {
    // The origin, moved towards the near planes of boxes and away from the far ones by the tolerance.
    Real nearOrigin[3], farOrigin[3];
    Real inverse[3];          // of the direction
    Real origin[3], shear[3]; // ShearedRay of shaders/lib/math/ray_triangle.glsl, turned

    // Changes the direction, as withoutZeros() of shaders/lib/math/ray_direction.glsl does.
    LAVALIGHT_TARGET void set(const Real (&from)[3], Real (&direction)[3], const Bounds& bounds) {
        const Real smallest = Real{} + kSmallestDirection;
        for (Real& along : direction)
            along = magnitude(along) < smallest ? withSignOf(smallest, along) : along;
        setSlabs(from, direction, bounds);
        setShear(from, direction);
    }

  private:
    LAVALIGHT_TARGET void setSlabs(const Real (&from)[3], const Real (&direction)[3], const Bounds& bounds) {
        Real reach = {};
        for (int axis = 0; axis < 3; ++axis)
            reach = larger(reach, larger(magnitude(from[axis] - bounds.lower[axis]),
                                         magnitude(bounds.upper[axis] - from[axis])));
        for (size_t axis = 0; axis < 3; ++axis) {
            // Far from the world's origin the sum would lose the tolerance. It does not lose two units in the
            // last place.
            const Real shift = kPlaneTolerance * reach + magnitude(from[axis]) * 0x1p-22f;
            const Real away = withSignOf(shift, direction[axis]);
            nearOrigin[axis] = from[axis] + away;
            farOrigin[axis] = from[axis] - away;
            inverse[axis] = 1.0f / direction[axis];
        }
    }
    LAVALIGHT_TARGET void setShear(const Real (&from)[3], const Real (&direction)[3]) {
        const Real size[] = {magnitude(direction[0]), magnitude(direction[1]), magnitude(direction[2])};
        const auto isX = (size[0] >= size[1]) & (size[0] >= size[2]);
        const auto isYUnlessX = size[1] >= size[2];
        const auto turned = [&](const Real(&v)[3], size_t i) LAVALIGHT_TARGET {
            return isX ? v[(i + 1) % 3] : isYUnlessX ? v[(i + 2) % 3] : v[i];
        };
        const Real main = turned(direction, 2);
        shear[0] = turned(direction, 0) / main;
        shear[1] = turned(direction, 1) / main;
        shear[2] = 1.0f / main;
        for (size_t i = 0; i < 3; ++i)
            origin[i] = turned(from, i);
    }
};

// A ray that boxes and triangles are tested with side by side.
struct LoneRay : RaySetup<float> {
    const Turn* turn;
    int32_t firstIgnored, secondIgnored;
};

// Lanes as bits, and where the ray meets them.
struct MetBoxes {
    uint32_t lanes;
    alignas(64) std::array<float, kBvh16Width> t;

    uint32_t takeLane() {
        const auto lane = static_cast<uint32_t>(std::countr_zero(lanes));
        lanes &= lanes - 1;
        return lane;
    }
};

struct MetTriangles {
    uint32_t lanes, fronts;
    alignas(64) std::array<float, kBvh16LeafWidth> t, b1, b2;

    // Returns the lane with the smallest t, and removes it.
    uint32_t next() {
        auto nearest = static_cast<uint32_t>(std::countr_zero(lanes));
        for (uint32_t rest = lanes & (lanes - 1); rest != 0; rest &= rest - 1) {
            const auto lane = static_cast<uint32_t>(std::countr_zero(rest));
            nearest = t[lane] < t[nearest] ? lane : nearest;
        }
        lanes &= ~(1u << nearest);
        return nearest;
    }
};

// Where rays are between the planes of boxes along one axis. Either the boxes or the rays are lanes.
template <typename Plane, typename Along>
LAVALIGHT_TARGET inline void clip(Plane nearPlane, Plane farPlane, Along nearOrigin, Along farOrigin,
                                  Along inverse, Floats& entry, Floats& exit) {
    entry = larger((nearPlane - nearOrigin) * inverse, entry);
    exit = smaller((farPlane - farOrigin) * inverse, exit);
}

LAVALIGHT_TARGET inline void meetBoxes(const LoneRay& ray, const Bvh16Node& node, float end, MetBoxes& met) {
    met.lanes = 0;
    for (uint32_t part = 0; part < kBvh16Width / LANES; ++part) {
        Floats entry = {};
        Floats exit = Floats{} + end;
        for (size_t axis = 0; axis < 3; ++axis)
            clip(load(node.planes[ray.turn->nearPlanes[axis]], part),
                 load(node.planes[ray.turn->farPlanes[axis]], part), ray.nearOrigin[axis],
                 ray.farOrigin[axis], ray.inverse[axis], entry, exit);
        met.lanes |= bitsOf(entry <= exit) << (part * LANES);
        store(met.t, part, entry);
    }
}

struct Corner {
    Floats x, y, z;
};

// shearCorner() of shaders/lib/math/ray_triangle.glsl, after turning.
template <typename Place, typename Along>
LAVALIGHT_TARGET inline Corner shearCorner(Place cornerX, Place cornerY, Place cornerZ,
                                           const Along (&origin)[3], const Along (&shear)[3]) {
    const Floats x = cornerX - origin[0];
    const Floats y = cornerY - origin[1];
    const Floats z = cornerZ - origin[2];
    return {x - shear[0] * z, y - shear[1] * z, shear[2] * z};
}

LAVALIGHT_TARGET inline Floats edgeFunction(const Corner& a, const Corner& b) {
    return a.x * b.y - a.y * b.x;
}

// intersectTriangle() of shaders/lib/math/ray_triangle.glsl, to the bit: on which side of the edges rays
// pass, and where they meet the triangle's plane.
struct Edges {
    Floats a, b, c, determinant;

    LAVALIGHT_TARGET Edges(const Corner& v0, const Corner& v1, const Corner& v2)
        : a(edgeFunction(v2, v1)), b(edgeFunction(v0, v2)), c(edgeFunction(v1, v0)), determinant(a + b + c) {}

    [[nodiscard]] LAVALIGHT_TARGET Ints areAroundRay() const {
        return ((smaller(smaller(a, b), c) >= 0.0f) | (larger(larger(a, b), c) <= 0.0f)) &
               (determinant != 0.0f);
    }
};

struct Meeting {
    Floats t, b1, b2;

    LAVALIGHT_TARGET Meeting(const Edges& edges, const Corner& v0, const Corner& v1, const Corner& v2) {
        const Floats scale = 1.0f / edges.determinant;
        b1 = edges.b * scale;
        b2 = edges.c * scale;
        t = edges.a * scale * v0.z + b1 * v1.z + b2 * v2.z;
    }
};

LAVALIGHT_TARGET inline void meetTriangles(const LoneRay& ray, const Bvh16Leaf& leaf, float end,
                                           MetTriangles& met) {
    met.lanes = met.fronts = 0;
    for (uint32_t part = 0; part < kBvh16LeafWidth / LANES; ++part) {
        const auto sheared = [&](const std::array<Bvh16Leaf::Floats, 3>& corner) LAVALIGHT_TARGET {
            return shearCorner(load(corner[ray.turn->axes[0]], part), load(corner[ray.turn->axes[1]], part),
                               load(corner[ray.turn->axes[2]], part), ray.origin, ray.shear);
        };
        const Corner v0 = sheared(leaf.corners[0]);
        const Corner v1 = sheared(leaf.corners[1]);
        const Corner v2 = sheared(leaf.corners[2]);
        const Edges edges(v0, v1, v2);
        const Ints isInside = edges.areAroundRay();
        if (bitsOf(isInside) == 0)
            continue;
        const Meeting meeting(edges, v0, v1, v2);
        const Ints triangles = load(leaf.triangles, part);
        const Ints isMet = isInside & (meeting.t > 0.0f) & (meeting.t <= end) &
                           (triangles != ray.firstIgnored) & (triangles != ray.secondIgnored);
        met.lanes |= bitsOf(isMet) << (part * LANES);
        met.fronts |= bitsOf(edges.determinant > 0.0f) << (part * LANES);
        store(met.t, part, meeting.t);
        store(met.b1, part, meeting.b1);
        store(met.b2, part, meeting.b2);
    }
    met.fronts = ray.shear[2] > 0.0f ? met.fronts : ~met.fronts;
}

LAVALIGHT_TARGET inline void visit(const Bvh16Leaf& leaf, const LoneRay& ray, MetTriangles& met,
                                   Search& search) {
    meetTriangles(ray, leaf, search.end, met);
    while (met.lanes != 0) {
        const uint32_t lane = met.next();
        if (met.t[lane] > search.end)
            return;
        search.meet({met.t[lane],
                     leaf.triangles[lane],
                     leaf.materials[lane],
                     {met.b1[lane], met.b2[lane]},
                     (met.fronts >> lane & 1u) != 0});
        if (search.isOver())
            return;
    }
}

// Children that wait, each behind the bits of the t where its box is entered: floats that are not negative
// are ordered as their bits are.
struct Stack {
    std::array<uint64_t, kMostWaiting> children;
    uint32_t size = 0;

    LAVALIGHT_TARGET static uint64_t waiting(const Bvh16Node& node, const MetBoxes& boxes, uint32_t lane) {
        return uint64_t{std::bit_cast<uint32_t>(boxes.t[lane])} << 32 | node.children[lane];
    }
    // Removes children from the top until one's box is entered at `end` or before; false: none is left.
    LAVALIGHT_TARGET bool pop(float end, uint32_t& child) {
        while (size > 0) {
            const uint64_t last = children[--size];
            child = static_cast<uint32_t>(last);
            if (std::bit_cast<float>(static_cast<uint32_t>(last >> 32)) <= end)
                return true;
        }
        return false;
    }
};

// Returns the nearest of the children that are met, at least one. The others wait, the nearest on top.
LAVALIGHT_TARGET inline uint32_t takeNearest(const Bvh16Node& node, MetBoxes& met, Stack& stack) {
    uint64_t nearest = Stack::waiting(node, met, met.takeLane());
    const uint32_t siblings = stack.size;
    while (met.lanes != 0) {
        const uint64_t other = Stack::waiting(node, met, met.takeLane());
        const uint64_t farther = std::max(nearest, other);
        nearest = std::min(nearest, other);
        uint32_t place = stack.size++;
        for (; place > siblings && stack.children[place - 1] < farther; --place)
            stack.children[place] = stack.children[place - 1];
        stack.children[place] = farther;
    }
    return static_cast<uint32_t>(nearest);
}

// Returns the largest of the children that are met, at least one. The others wait, the largest on top.
LAVALIGHT_TARGET inline uint32_t takeLargest(const Bvh16Node& node, MetBoxes& met, Stack& stack) {
    const uint32_t largest = met.takeLane();
    for (; met.lanes != 0; met.lanes &= ~std::bit_floor(met.lanes))
        stack.children[stack.size++] =
            Stack::waiting(node, met, static_cast<uint32_t>(std::bit_width(met.lanes)) - 1);
    return node.children[largest];
}

LAVALIGHT_TARGET inline void traverse(const Bvh16& bvh, const LoneRay& ray, Search& search) {
    Stack stack;
    MetBoxes boxes;
    MetTriangles triangles;
    uint32_t child = 0;
    do {
        while ((child & kBvh16LeafBit) == 0) {
            const Bvh16Node& node = bvh.nodes[child];
            meetBoxes(ray, node, search.end * kMargin, boxes);
            if (boxes.lanes != 0)
                child = search.isAny ? takeLargest(node, boxes, stack) : takeNearest(node, boxes, stack);
            else if (!stack.pop(search.end * kMargin, child))
                return;
        }
        visit(bvh.leaves[child & ~kBvh16LeafBit], ray, triangles, search);
    } while (!search.isOver() && stack.pop(search.end * kMargin, child));
}

// Rays side by side. Lanes without a ray, or whose ray is over, have an end below 0 and meet nothing.
struct RayLanes : RaySetup<Floats> {
    std::array<uint32_t, LANES> rays{};    // their numbers
    std::array<uint32_t, LANES> classes{}; // of their directions
    Floats end;                            // as Search::end
    Ints firstIgnored, secondIgnored;
    uint32_t culling; // lanes that cull back faces

    [[nodiscard]] LAVALIGHT_TARGET LoneRay alone(uint32_t lane) const {
        LoneRay ray;
        for (size_t i = 0; i < 3; ++i) {
            ray.nearOrigin[i] = nearOrigin[i][lane];
            ray.farOrigin[i] = farOrigin[i][lane];
            ray.inverse[i] = inverse[i][lane];
            ray.origin[i] = origin[i][lane];
            ray.shear[i] = shear[i][lane];
        }
        ray.turn = &kTurns[classes[lane]];
        ray.firstIgnored = firstIgnored[lane];
        ray.secondIgnored = secondIgnored[lane];
        return ray;
    }
    [[nodiscard]] Search search(uint32_t lane, bool isAny, TriangleTaker taker) const {
        return {taker, rays[lane], (culling >> lane & 1u) != 0, isAny, end[lane]};
    }
};

// The rays with these numbers, at most LANES.
LAVALIGHT_TARGET inline RayLanes gather(const Bvh16& bvh, std::span<const Bvh16Ray> rays,
                                        std::span<const uint32_t> numbers) {
    RayLanes lanes;
    Floats origin[3] = {};
    Floats direction[3] = {};
    lanes.end = Floats{} - 1.0f;
    lanes.firstIgnored = lanes.secondIgnored = Ints{};
    lanes.culling = 0;
    for (size_t lane = 0; lane < numbers.size(); ++lane) {
        const Bvh16Ray& ray = rays[numbers[lane]];
        for (int axis = 0; axis < 3; ++axis) {
            origin[axis][lane] = ray.origin[axis];
            direction[axis][lane] = ray.direction[axis];
        }
        lanes.rays[lane] = numbers[lane];
        lanes.classes[lane] = directionClass(ray.direction);
        lanes.end[lane] = ray.end;
        lanes.firstIgnored[lane] = static_cast<int32_t>(ray.firstIgnored);
        lanes.secondIgnored[lane] = static_cast<int32_t>(ray.secondIgnored);
        lanes.culling |= (ray.cullsBackFaces ? 1u : 0u) << lane;
    }
    Floats sum = {};
    for (size_t axis = 0; axis < 3; ++axis)
        sum += origin[axis] + direction[axis];
    const Ints isFinite = sum - sum == 0.0f;
    lanes.end = isFinite ? lanes.end : Floats{} - 1.0f;
    lanes.set(origin, direction, bvh.bounds);
    return lanes;
}

// Rays with directions of one class, which meet the same boxes and triangles at a time.
struct Packet {
    RayLanes rays;
    TriangleTaker taker;
    bool isAny;
    const Turn& turn; // of their class
    // What comes first so far.
    Ints triangles, materials; // ids are below 2^31; no triangle: -1
    Floats t, b1, b2;
    uint32_t fronts;

    LAVALIGHT_TARGET Packet(const RayLanes& lanes, bool any, TriangleTaker asked)
        : rays(lanes), taker(asked), isAny(any), turn(kTurns[lanes.classes[0]]),
          triangles(Ints{} - 1), materials{}, t{}, b1{}, b2{}, fronts(0) {}
    [[nodiscard]] LAVALIGHT_TARGET Bvh16Hit hit(uint32_t lane) const {
        return {t[lane],
                static_cast<uint32_t>(triangles[lane]),
                static_cast<uint32_t>(materials[lane]),
                {b1[lane], b2[lane]},
                (fronts >> lane & 1u) != 0};
    }
};

// Takes out of `isMet` the lanes whose rays do not take the leaf's triangle.
LAVALIGHT_TARGET inline void ask(const Packet& packet, const Bvh16Leaf& leaf, uint32_t triangle,
                                 const Meeting& meeting, uint32_t fronts, Ints& isMet) {
    const bool hasAlpha = (leaf.materials[triangle] & kAlphaBit) != 0;
    uint32_t asked = bitsOf(isMet) & (hasAlpha ? ~0u : packet.rays.culling & ~fronts);
    for (; asked != 0; asked &= asked - 1) {
        const auto lane = static_cast<uint32_t>(std::countr_zero(asked));
        const Bvh16Hit hit{meeting.t[lane],
                           leaf.triangles[triangle],
                           leaf.materials[triangle],
                           {meeting.b1[lane], meeting.b2[lane]},
                           (fronts >> lane & 1u) != 0};
        if (!packet.taker.takes(packet.taker.taker, packet.rays.rays[lane], hit))
            isMet[lane] = 0;
    }
}

LAVALIGHT_TARGET inline void visit(const Bvh16Leaf& leaf, Packet& packet) {
    RayLanes& rays = packet.rays;
    for (uint32_t i = 0; i < leaf.count; ++i) {
        const auto sheared = [&](const std::array<Bvh16Leaf::Floats, 3>& corner) LAVALIGHT_TARGET {
            return shearCorner(corner[packet.turn.axes[0]][i], corner[packet.turn.axes[1]][i],
                               corner[packet.turn.axes[2]][i], rays.origin, rays.shear);
        };
        const Corner v0 = sheared(leaf.corners[0]);
        const Corner v1 = sheared(leaf.corners[1]);
        const Corner v2 = sheared(leaf.corners[2]);
        const Edges edges(v0, v1, v2);
        Ints isMet = edges.areAroundRay();
        if (bitsOf(isMet) == 0)
            continue;
        const Meeting meeting(edges, v0, v1, v2);
        const auto triangle = static_cast<int32_t>(leaf.triangles[i]);
        const Ints comesFirst =
            (meeting.t < rays.end) | ((meeting.t == rays.end) & (triangle < packet.triangles));
        isMet &= (meeting.t > 0.0f) & comesFirst & (triangle != rays.firstIgnored) &
                 (triangle != rays.secondIgnored);
        if (bitsOf(isMet) == 0)
            continue;
        const uint32_t fronts = bitsOf((edges.determinant > 0.0f) == (rays.shear[2] > 0.0f));
        if ((leaf.materials[i] & kAlphaBit) != 0 || (rays.culling & ~fronts) != 0)
            ask(packet, leaf, i, meeting, fronts, isMet);
        const uint32_t met = bitsOf(isMet);
        packet.fronts = (packet.fronts & ~met) | (fronts & met);
        packet.triangles = isMet ? Ints{} + triangle : packet.triangles;
        packet.materials = isMet ? Ints{} + static_cast<int32_t>(leaf.materials[i]) : packet.materials;
        packet.t = isMet ? meeting.t : packet.t;
        packet.b1 = isMet ? meeting.b1 : packet.b1;
        packet.b2 = isMet ? meeting.b2 : packet.b2;
        rays.end = isMet ? (packet.isAny ? Floats{} - 1.0f : meeting.t) : rays.end;
    }
}

// A child that waits, and where each ray enters its box; NaN where it does not, which is before no end.
struct WaitingChild {
    Floats entry;
    uint32_t child;
};

// Puts the children whose boxes rays enter on a stack, and returns their number. On top is the child with the
// smallest entry, taken from the lowest lane that enters each; or the largest child, where any triangle ends
// a ray.
LAVALIGHT_TARGET inline uint32_t enter(const Bvh16Node& node, const Packet& packet, WaitingChild* stack) {
    const Floats end = packet.rays.end * kMargin;
    std::array<Floats, kBvh16Width> entries;
    std::array<uint64_t, kBvh16Width> order; // in falling order
    uint32_t count = 0;
    for (uint32_t child = 0; child < kBvh16Width; ++child) {
        if (node.planes[0][child] > node.planes[3][child])
            break; // this one and all after it are missing
        Floats entry = {};
        Floats exit = end;
        for (size_t axis = 0; axis < 3; ++axis)
            clip(node.planes[packet.turn.nearPlanes[axis]][child],
                 node.planes[packet.turn.farPlanes[axis]][child], packet.rays.nearOrigin[axis],
                 packet.rays.farOrigin[axis], packet.rays.inverse[axis], entry, exit);
        const Ints isEntered = entry <= exit;
        const uint32_t lanes = bitsOf(isEntered);
        if (lanes == 0)
            continue;
        entries[child] = isEntered ? entry : Floats{} + std::numeric_limits<float>::quiet_NaN();
        const float first = entries[child][std::countr_zero(lanes)];
        const uint64_t key = uint64_t{packet.isAny ? 0 : std::bit_cast<uint32_t>(first)} << 32 | child;
        uint32_t place = count++;
        for (; place > 0 && order[place - 1] < key; --place)
            order[place] = order[place - 1];
        order[place] = key;
    }
    for (uint32_t i = 0; i < count; ++i) {
        const auto child = static_cast<uint32_t>(order[i]);
        stack[i] = {entries[child], node.children[child]};
    }
    return count;
}

LAVALIGHT_TARGET inline void traverse(const Bvh16& bvh, Packet& packet) {
    std::array<WaitingChild, kMostWaiting> stack;
    uint32_t size = enter(bvh.nodes[0], packet, stack.data());
    while (size > 0) {
        const WaitingChild& last = stack[--size];
        const uint32_t child = last.child;
        if (bitsOf(last.entry <= packet.rays.end * kMargin) == 0)
            continue;
        if ((child & kBvh16LeafBit) != 0)
            visit(bvh.leaves[child & ~kBvh16LeafBit], packet);
        else
            size += enter(bvh.nodes[child], packet, &stack[size]);
    }
}

// Finds what rays of any directions meet, at most LANES: one after the other.
LAVALIGHT_TARGET void findOneByOne(const Bvh16Query& query, std::span<const uint32_t> numbers) {
    const RayLanes lanes = gather(query.bvh, query.rays, numbers);
    for (uint32_t lane = 0; lane < numbers.size(); ++lane) {
        Search search = lanes.search(lane, query.sought == Sought::any, query.taker);
        if (search.end >= 0.0f)
            traverse(query.bvh, lanes.alone(lane), search);
        query.hits[numbers[lane]] = search.first;
    }
}

// Finds what rays of one class of directions meet, at most LANES: all at a time.
LAVALIGHT_TARGET void findTogether(const Bvh16Query& query, std::span<const uint32_t> numbers) {
    Packet packet(gather(query.bvh, query.rays, numbers), query.sought == Sought::any, query.taker);
    traverse(query.bvh, packet);
    for (uint32_t lane = 0; lane < numbers.size(); ++lane)
        query.hits[numbers[lane]] = packet.hit(lane);
}

// Finds what a ray that is alone meets.
LAVALIGHT_TARGET void findOne(const Bvh16Query& query) {
    const Bvh16Ray& ray = query.rays[0];
    const float origin[] = {ray.origin.x, ray.origin.y, ray.origin.z};
    float direction[] = {ray.direction.x, ray.direction.y, ray.direction.z};
    const glm::vec3 sum = ray.origin + ray.direction;
    Search search{query.taker, 0, ray.cullsBackFaces, query.sought == Sought::any, ray.end};
    if (std::isfinite(sum.x + sum.y + sum.z)) {
        LoneRay lone;
        lone.set(origin, direction, query.bvh.bounds);
        lone.turn = &kTurns[directionClass(ray.direction)];
        lone.firstIgnored = static_cast<int32_t>(ray.firstIgnored);
        lone.secondIgnored = static_cast<int32_t>(ray.secondIgnored);
        traverse(query.bvh, lone, search);
    }
    query.hits[0] = search.first;
}

LAVALIGHT_TARGET void find(const Bvh16Query& query) {
    if (query.rays.size() == 1) {
        findOne(query);
        return;
    }
    const bool together = query.likeness == Likeness::alike || query.bvh.nodes.size() <= kMostNodesOfPackets;
    for (size_t first = 0; first < query.rays.size(); first += kRaysAtATime) {
        const size_t count = std::min(kRaysAtATime, query.rays.size() - first);
        const RayOrder order(query.rays.subspan(first, count), first, together);
        for (size_t start = 0; start < count;) {
            const size_t end = std::min<size_t>(start + LANES, order.endOfClass(start));
            const auto numbers = order.numbers(start, end);
            together ? findTogether(query, numbers) : findOneByOne(query, numbers);
            start = end;
        }
    }
}
