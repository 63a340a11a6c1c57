# The image in which cibuildwheel makes the wheels of a release (docs/release.md). It is Debian 12,
# whose libraries and licences go into the wheels, with interpreters where cibuildwheel expects
# them.
#   docker build --tag rholm-wheels - < scripts/wheel.Dockerfile
FROM debian:bookworm
RUN apt-get update \
 && apt-get install --yes --no-install-recommends ca-certificates python3-venv \
 && rm -rf /var/lib/apt/lists/* \
 && python3 -m venv /opt/uv && /opt/uv/bin/pip install --no-cache-dir uv
# cibuildwheel runs its own tasks with cp39: any version serves.
RUN for version in 310 311 312 313; do \
      /opt/uv/bin/uv venv --managed-python --seed --python 3.${version#3} /opt/python/cp$version-cp$version || exit 1; \
    done \
 && ln -s cp311-cp311 /opt/python/cp39-cp39
