# PLM-VINS on Ubuntu 20.04 with ROS Noetic. From the checkout:
#   docker build --pull -f docker/noetic.Dockerfile -t plm_vins .
#   docker run --rm -v /path/to/data:/data plm_vins run_offline --config /plm_vins/config/euroc.yaml \
#     --bag /data/MH_05_difficult.bag --output /data/results
FROM ros:noetic-ros-base-focal

COPY scripts/setup.sh scripts/usage.sh /plm_vins/scripts/
RUN /plm_vins/scripts/setup.sh && rm -rf /var/lib/apt/lists/*

COPY . /plm_vins
RUN /plm_vins/scripts/build.sh -DBUILD_TESTING=OFF

ENV PATH=/plm_vins/build/devel/lib/plm_vins:$PATH
ENTRYPOINT ["/plm_vins/docker/entrypoint.sh"]
CMD ["bash"]
