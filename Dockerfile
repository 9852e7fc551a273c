# Any Debian with Python 3.11 or newer and pip will do as a base.
ARG BASE=python:3.11-slim

FROM ${BASE} AS base
# The base fixes Debian's release; a version pinned here would only keep out its security updates.
# hadolint ignore=DL3008
RUN apt-get update \
    && apt-get install --yes --no-install-recommends libgomp1 \
    && apt-get clean \
    && rm -rf /var/lib/apt/lists/*
WORKDIR /opt/gelenk

FROM base AS builder
COPY requirements.lock ./
RUN python3 -m venv --without-pip /opt/venv \
    && python3 -m pip --python /opt/venv/bin/python install --no-cache-dir --require-hashes --no-deps -r requirements.lock
ENV PATH=/opt/venv/bin:$PATH
COPY app app
COPY robots robots
COPY LICENSE ./
RUN python -m compileall -q app \
    && python -m app.prune /opt/venv \
    && find /opt/venv -type d -empty -delete
# What is left must still load, and leaves its compiled kernels behind.
RUN NUMBA_CACHE_DIR=kernels python -c "import app.main; from app.kinematics.warm import warm_up; warm_up()"

FROM base
LABEL org.opencontainers.image.title="Gelenk" \
    org.opencontainers.image.description="Robot kinematics over HTTP, every answer certified" \
    org.opencontainers.image.version="0.1.0" \
    org.opencontainers.image.licenses="BSD-3-Clause"
COPY --from=builder /opt/venv /opt/venv
COPY --from=builder /opt/gelenk /opt/gelenk
RUN install --directory --owner=10001 --group=10001 /data
# Kernels for another processor are compiled anew, beside those of the image: only /tmp and /data are written to.
ENV PATH=/opt/venv/bin:$PATH \
    PYTHONDONTWRITEBYTECODE=1 \
    PYTHONUNBUFFERED=1 \
    NUMBA_CACHE_DIR=/tmp/kernels \
    MPLCONFIGDIR=/tmp/matplotlib \
    GELENK_DATA_DIR=/data
VOLUME /data
EXPOSE 8000
STOPSIGNAL SIGTERM
USER 10001:10001
HEALTHCHECK --interval=30s --timeout=5s --start-period=30s \
    CMD ["python", "-c", "from urllib.request import urlopen; urlopen('http://127.0.0.1:8000/healthz', timeout=4)"]
ENTRYPOINT ["sh", "-c", "cp -rT kernels /tmp/kernels && exec python -m app.serve --host 0.0.0.0 \"$@\"", "gelenk"]
