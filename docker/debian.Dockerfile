# PLM-VINS on Debian 12, or 11 or 13 (--build-arg DEBIAN=13), with its own ROS 1 packages. From the
# checkout:
#   docker build -f docker/debian.Dockerfile -t plm_vins .
#   docker run --rm -v /path/to/data:/data plm_vins run_offline --config /plm_vins/config/euroc.yaml \
#     --bag /data/MH_05_difficult.bag --output /data/results
ARG DEBIAN=12
FROM debian:$DEBIAN

COPY scripts/setup.sh scripts/usage.sh /plm_vins/scripts/
RUN /plm_vins/scripts/setup.sh && rm -rf /var/lib/apt/lists/*

COPY . /plm_vins
RUN /plm_vins/scripts/build.sh -DBUILD_TESTING=OFF

ENV PATH=/plm_vins/build/devel/lib/plm_vins:$PATH
ENTRYPOINT ["/plm_vins/docker/entrypoint.sh"]
CMD ["bash"]
