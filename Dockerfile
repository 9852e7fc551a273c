# Any Debian with Python 3.11 or newer and pip will do as a base.
ARG BASE=python:3.11-slim

FROM ${BASE} AS base
# The base fixes Debian's release; a version pinned here would only keep out its security updates.
# hadolint ignore=DL3008
RUN apt-get update \
    && apt-get install --yes --no-install-recommends libgomp1 \
    && rm -rf /var/cache/apt/* /var/lib/apt/lists/*

# The handbook, of which only the pages go on. pip takes no hashes of what another package asks for: they are compared.
FROM base AS handbook
WORKDIR /build
COPY requirements-dev.lock ./
RUN sed '/--hash/d; s/ \\$//' requirements-dev.lock > versions \
    && python3 -m pip download --no-cache-dir --only-binary=:all: --constraint versions --dest wheels \
        sphinx furo myst-parser ziamath \
    && for wheel in wheels/*; do \
        sum=$(sha256sum "$wheel") && grep --quiet "sha256:${sum%% *}" requirements-dev.lock || exit 1; done \
    && python3 -m venv --without-pip /opt/sphinx \
    && python3 -m pip --python /opt/sphinx/bin/python install --no-cache-dir --no-index --no-deps wheels/*
COPY app/gelenk/studio/icon.svg app/gelenk/studio/
COPY docs docs
RUN /opt/sphinx/bin/python -m sphinx --fail-on-warning --quiet --doctree-dir /tmp --conf-dir docs/handbook docs handbook

FROM base AS builder
# hadolint ignore=DL3008
RUN apt-get update && apt-get install --yes --no-install-recommends binutils
WORKDIR /build
COPY requirements.lock ./
RUN python3 -m venv --without-pip /opt/venv \
    && python3 -m pip --python /opt/venv/bin/python install --no-cache-dir --require-hashes --no-deps -r requirements.lock
COPY pyproject.toml README.md LICENSE ./
COPY app app
COPY robots robots
COPY --from=handbook /build/handbook build/handbook
RUN python3 -m pip --python /opt/venv/bin/python install --no-cache-dir --no-deps --no-build-isolation . \
    && python3 -m pip --python /opt/venv/bin/python uninstall --yes hatchling pathspec pluggy tomlkit trove-classifiers
ENV PATH=/opt/venv/bin:$PATH
# Symbols for debuggers go too, but not of what auditwheel has put into `*.libs`: `strip` breaks its alignment.
RUN python -m gelenk.prune /opt/venv \
    && find /opt/venv -name '*.so*' -type f ! -path '*.libs/*' -exec strip --strip-unneeded {} + \
    && find /opt/venv -type d -empty -delete
WORKDIR /opt/gelenk
# What is left must still load, and leaves its compiled kernels behind.
RUN NUMBA_CACHE_DIR=kernels python -c "import gelenk.main, gelenk.plots.profiles, sympy; from gelenk.kinematics.warm_up import warm_up; warm_up()"

# Of the base what a service opens: no pip, no translations, no manuals but the licences.
FROM base AS slim
RUN find / -xdev -depth -path '*-packages/*' \( -name 'pip' -o -name 'pip-*' -o -name 'setuptools*' -o -name 'pkg_resources' \
        -o -name 'wheel' -o -name 'wheel-*' \) -exec rm -rf {} + \
    && find / -xdev -depth -type d \( -path '*/python3*/ensurepip' -o -path '*/python3*/idlelib' -o -path '*/python3*/lib2to3' \
        -o -path '*/python3*/pydoc_data' -o -path '*/share/python-wheels' \) -exec rm -rf {} + \
    && find /usr/share/doc -type f ! -name copyright -delete \
    && rm -rf /usr/share/locale /usr/share/man /usr/share/info /usr/lib/*/gconv /usr/lib/*/perl-base /usr/bin/perl* /var/cache/*
RUN install --directory --owner=10001 --group=10001 /data

FROM scratch
LABEL org.opencontainers.image.title="Gelenk" \
    org.opencontainers.image.description="Robot kinematics over HTTP, every answer certified" \
    org.opencontainers.image.version="0.1.0" \
    org.opencontainers.image.licenses="BSD-3-Clause"
# As one layer, so that nothing of what was removed is below it.
# hadolint ignore=DL3067
COPY --from=slim / /
COPY --from=builder /opt /opt
WORKDIR /opt/gelenk
# Kernels for another processor are compiled anew, beside those of the image: only /tmp and /data are written to.
ENV PATH=/opt/venv/bin:/usr/local/bin:/usr/bin:/bin \
    LANG=C.UTF-8 \
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
ENTRYPOINT ["sh", "-c", "cp -rT kernels /tmp/kernels && exec python -m gelenk.serve --host 0.0.0.0 \"$@\"", "gelenk"]
