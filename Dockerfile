# Lavalight on Debian 13, of this checkout:
#
#   docker build --build-arg COMMIT="$(git rev-parse --short=12 HEAD)" --tag lavalight .
#   docker run --rm --volume "$PWD:/work" lavalight render cornell-box --png picture.png
#
# The base is named by its date, so that it changes in a commit and not by itself.
ARG BASE=debian:trixie-20251117-slim

FROM ${BASE} AS build
WORKDIR /lavalight
COPY tools/setup tools/setup
RUN tools/setup --program file && rm -rf /var/lib/apt/lists/*
COPY . .
ARG COMMIT=""
RUN cmake --preset release -DBUILD_TESTING=OFF -DLAVALIGHT_COMMIT="$COMMIT" \
    && cmake --build --preset release \
    && cpack --config build/release/CPackConfig.cmake

FROM ${BASE}
# Of Mesa, lavapipe alone: a container has no desktop, and the drivers of cards take 110 MB.
COPY packaging/container_excludes /etc/dpkg/dpkg.cfg.d/lavalight
RUN --mount=type=bind,from=build,source=/lavalight/build/release/packages,target=/packages \
    apt-get update \
    && apt-get install -y --no-install-recommends /packages/lavalight_*.deb \
    && rm -rf /var/lib/apt/lists/* /var/cache/apt/*
WORKDIR /work
ENTRYPOINT ["lavalight"]
