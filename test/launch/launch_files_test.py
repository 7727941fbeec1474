#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests which nodes and parameters the launch files of the package plm_vins would start.

The environment of ROS selects the package: the one of the build or an installed one.
"""

import os
import pathlib
import shlex
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree

import roslaunch
import roslib.packages
import rospkg

LAUNCH = pathlib.Path(rospkg.RosPack().get_path("plm_vins")) / "launch"
# Launch files with a default configuration, and those that require an argument.
SENSORS = {f"{name}.launch": f"{name}.yaml" for name in (
    "euroc", "euroc_stereo", "realsense_d435i", "realsense_d435i_depth", "realsense_d435i_stereo",
    "tum_vi")}
TEMPLATES = ("own_sensor.launch", "plm_vins.launch", "px4.launch", "rig.launch")
ALL = (*SENSORS, *TEMPLATES)
TRACKERS = ("feature_tracker", "linefeature_tracker")
NODELETS = {"feature_tracker": "plm_vins/FeatureTracker",
            "linefeature_tracker": "plm_vins/LineFeatureTracker",
            "vins_estimator": "plm_vins/VinsEstimator",
            "pose_graph": "plm_vins/PoseGraph"}

# Arguments of rs_camera.launch in the driver, realsense2_camera 2.3.
DRIVER_ARGUMENTS = ("enable_infra1", "enable_infra2", "enable_depth", "enable_color", "infra_width",
                    "infra_height", "infra_fps", "depth_width", "depth_height", "depth_fps",
                    "enable_gyro", "enable_accel", "gyro_fps", "unite_imu_method", "enable_sync")


PACKAGE_PATH = os.environ["ROS_PACKAGE_PATH"]


def setUpModule():
    """Creates packages that replace the camera's driver and mavros in all tests, since ROS caches
    the packages that it finds."""
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    make_package(folder.name, "realsense2_camera", "rs_camera.launch", "driver", DRIVER_ARGUMENTS)
    make_package(folder.name, "mavros", "px4.launch", "mavros", ("fcu_url",))
    os.environ["ROS_PACKAGE_PATH"] = f"{folder.name}:{PACKAGE_PATH}"


def make_package(folder, name, launch_file, namespace, arguments):
    """Creates a package whose launch file sets its arguments as parameters."""
    package = pathlib.Path(folder) / name
    (package / "launch").mkdir(parents=True)
    (package / "package.xml").write_text(f"<package><name>{name}</name></package>")
    text = "".join(f'<arg name="{argument}" default=""/><param name="/{namespace}/{argument}"'
                   f' value="$(arg {argument})"/>' for argument in arguments)
    (package / "launch" / launch_file).write_text(f"<launch>{text}</launch>")


def configuration(file, **arguments):
    """Returns the configuration that a launch file yields with these arguments."""
    words = [f"{key}:={value}" for key, value in arguments.items()]
    return roslaunch.config.load_config_default([(str(file), words)], None, verbose=False,
                                                assign_machines=False)


def load(name, **arguments):
    """Returns the nodes by name and the parameters of one of our launch files."""
    config = configuration(LAUNCH / name, **arguments)
    return ({node.name: node for node in config.nodes},
            {key: parameter.value for key, parameter in config.params.items()})


def robot_configuration(name, **arguments):
    """Returns the configuration of one of our launch files, included by a robot's launch file in a
    namespace."""
    with tempfile.NamedTemporaryFile("w", suffix=".launch") as file:
        file.write(f'<launch><group ns="robot1"><include file="{LAUNCH / name}"'
                   ' pass_all_args="true"/></group></launch>')
        file.flush()
        return configuration(file.name, **arguments)


def player_words(name="plm_vins.launch", **arguments):
    return shlex.split(load(name, config="c.yaml", **arguments)[0]["player"].args)


def rviz_layout(nodes):
    """Returns the name of the configuration file with which rviz starts."""
    file = pathlib.Path(shlex.split(nodes["rviz"].args)[1])
    assert file.is_file(), file
    return file.name


class LaunchFiles(unittest.TestCase):
    def test_every_file_is_known_here(self):
        self.assertEqual(sorted(ALL), sorted(path.name for path in LAUNCH.glob("*.launch")))

    def test_every_file_is_found_by_its_name(self):
        """No name is missing or ambiguous: roslaunch rejects two files of the same name."""
        for name in ALL:
            self.assertEqual(roslib.packages.find_resource("plm_vins", name),
                             [str(LAUNCH / name)])

    def test_programs_exist_and_share_one_configuration(self):
        for name in ALL:
            with self.subTest(name):
                nodes, parameters = load(name, config="/mine.yaml", bag="/a.bag")
                ours = {node.name: node for node in nodes.values() if node.package == "plm_vins"}
                for node in ours.values():
                    self.assertTrue(roslib.packages.find_node(
                        "plm_vins", node.type), node.type)
                for without_configuration in ("mavros_relay", "player"):
                    ours.pop(without_configuration, None)
                self.assertEqual(sorted(ours),
                                 ["feature_tracker", "linefeature_tracker", "pose_graph",
                                  "vins_estimator"])
                for node_name in ours:
                    self.assertEqual(parameters[f"/{node_name}/config_file"], "/mine.yaml")

    def test_sensors_have_a_configuration(self):
        for name, config in SENSORS.items():
            file = pathlib.Path(load(name, bag="/a.bag")[1]["/vins_estimator/config_file"])
            self.assertEqual(file.name, config)
            self.assertTrue(file.is_file(), file)

    def test_without_lines(self):
        nodes, parameters = load("euroc.launch", lines="false")
        self.assertNotIn("linefeature_tracker", nodes)
        self.assertEqual(parameters["/vins_estimator/set/use_lines"], "0")

    def test_nodes_that_end_take_all_with_them_or_come_back(self):
        for respawn in (False, True):
            for manager in ("", "/camera/manager"):
                nodes, _ = load("plm_vins.launch", config="c.yaml", manager=manager,
                                loop_closure=True, **({"respawn": True} if respawn else {}))
                for name in ("linefeature_tracker", "pose_graph"):
                    self.assertTrue(nodes.pop(name).respawn, f"{name} is no must")
                for node in nodes.values():
                    self.assertEqual((node.respawn, node.required), (respawn, not respawn),
                                     node.name)

    def test_one_process_that_ends_takes_all_with_it_or_comes_back(self):
        for respawn in (False, True):
            nodes, _ = load("plm_vins.launch", config="c.yaml", nodelets=True,
                            **({"respawn": True} if respawn else {}))
            self.assertEqual(list(nodes), ["vins_manager"])
            manager = nodes["vins_manager"]
            self.assertEqual((manager.respawn, manager.required), (respawn, not respawn))

    def test_one_process_instead_of_nodes(self):
        for name in ALL:
            with self.subTest(name):
                nodes, parameters = load(name, config="/mine.yaml", bag="/a.bag", nodelets="true")
                self.assertEqual(nodes["vins_manager"].type, "vins_manager")
                self.assertFalse(NODELETS.keys() & nodes.keys())
                for node, nodelet in NODELETS.items():
                    self.assertEqual(parameters[f"/vins_manager/nodelets/{node}"], nodelet)
                    self.assertEqual(parameters[f"/{node}/config_file"], "/mine.yaml")

    def test_one_process_without_lines_and_loops(self):
        parameters = load("euroc.launch", nodelets="true", lines="false", loop_closure="false")[1]
        self.assertEqual(sorted(name for name in parameters if "/nodelets/" in name),
                         ["/vins_manager/nodelets/feature_tracker",
                          "/vins_manager/nodelets/vins_estimator"])

    def test_nodelets_join_the_manager_of_a_driver(self):
        for name in ALL:
            nodes = load(name, config="c.yaml", manager="/camera/manager")[0]
            for node, nodelet in NODELETS.items():
                self.assertEqual(nodes[node].package, "nodelet")
                self.assertEqual(nodes[node].args, f"load {nodelet} /camera/manager")
            self.assertNotIn("vins_manager", nodes)

    def test_nodes_are_no_nodelets_where_that_is_said(self):
        for arguments in ({}, {"nodelets": "false", "manager": "/camera/manager"}):
            nodes = load("euroc.launch", **arguments)[0]
            for node in NODELETS:
                self.assertEqual(nodes[node].package, "plm_vins")

    def test_nodelets_are_described_where_the_manager_looks(self):
        package = rospkg.RosPack().get_path("plm_vins")
        file = rospkg.RosPack().get_manifest("plm_vins").get_export("nodelet", "plugin")[0]
        description = xml.etree.ElementTree.parse(file.replace("${prefix}", package))
        for library in description.iter("library"):
            self.assertTrue(any((pathlib.Path(prefix) / f"{library.get('path')}.so").is_file()
                                for prefix in os.environ["CMAKE_PREFIX_PATH"].split(":")),
                            library.get("path"))
        self.assertEqual(sorted(entry.get("name") for entry in description.iter("class")),
                         sorted(NODELETS.values()))

    def test_robots_have_namespaces(self):
        for nodelets in (False, True):
            config = robot_configuration("px4.launch", config="c.yaml", nodelets=nodelets)
            self.assertEqual({node.namespace for node in config.nodes}, {"/robot1/"})
            self.assertFalse([key for key in config.params
                              if not key.startswith(("/robot1/", "/ros", "/run_id"))])

    def test_templates_ask_for_a_configuration(self):
        for name in TEMPLATES:
            with self.assertRaisesRegex(Exception, "config"):
                load(name)

    def test_live_sensors_keep_their_clock(self):
        nodes, parameters = load("plm_vins.launch", config="c.yaml")
        self.assertNotIn("player", nodes)
        self.assertNotIn("rviz", nodes)
        self.assertNotIn("/use_sim_time", parameters)

    def test_bag(self):
        words = player_words(bag="/data/my flight.bag", start=5, duration=2.5, rate=0.5)
        self.assertEqual(words[0], "/data/my flight.bag")
        for option, value in (("--start", "5"), ("--duration", "2.5"), ("--rate", "0.5")):
            self.assertEqual(words[words.index(option) + 1], value)
        self.assertIn("--clock", words)
        self.assertIn("--quiet", words)  # progress output would overwrite messages of the nodes
        self.assertNotIn("--duration", player_words(bag="/a.bag"))
        self.assertEqual(player_words(bag="/a.bag /b.bag")[0], "/a.bag /b.bag")
        player = load("plm_vins.launch", config="c.yaml", bag="/a.bag")[0]["player"]
        self.assertTrue(roslib.packages.find_node(player.package, player.type))
        for name in ALL:
            self.assertTrue(load(name, config="c.yaml", bag="/a.bag")[1]["/use_sim_time"])

    def test_options_reach_the_nodes(self):
        nodes, parameters = load("tum_vi.launch", rviz="true", image_transport="compressed",
                                 output="/results")
        for tracker in TRACKERS:
            self.assertEqual(parameters[f"/{tracker}/image_transport"], "compressed")
        self.assertEqual(parameters["/vins_estimator/trajectory_file"], "/results/trajectory.tum")
        self.assertEqual(rviz_layout(nodes), "plm_vins.rviz")

    def test_nodes_forget_the_options_of_an_earlier_launch(self):
        """Parameters remain on the master after a launch ends, so each launch must clear them."""
        for name in ALL:
            for nodelets in (False, True):
                config = configuration(LAUNCH / name, config="c.yaml", bag="/a.bag",
                                       loop_closure="true", nodelets=nodelets)
                ours = {node.name for node in config.nodes if node.package == "plm_vins"}
                self.assertEqual(sorted(config.clear_params),
                                 sorted(f"/{name}/" for name in ours | NODELETS.keys()))

    def test_the_configuration_decides_on_loop_closure(self):
        nodes, parameters = load("euroc.launch", output="/results")
        self.assertFalse(nodes["pose_graph"].respawn, "it ends where it is switched off")
        self.assertEqual({key for key in parameters if key.startswith("/pose_graph/")},
                         {"/pose_graph/config_file", "/pose_graph/image_transport",
                          "/pose_graph/output"})
        self.assertEqual(parameters["/pose_graph/output"], "/results")

    def test_arguments_override_the_configuration_on_loop_closure(self):
        nodes, parameters = load("euroc.launch", loop_closure="true", load_map="true",
                                 map_file="/house.plm")
        self.assertTrue(nodes["pose_graph"].respawn)
        self.assertEqual(parameters["/pose_graph/set/loop_closure"], "1")
        self.assertEqual(parameters["/pose_graph/set/load_previous_pose_graph"], "1")
        self.assertEqual(parameters["/pose_graph/map_file"], "/house.plm")
        self.assertNotIn("pose_graph", load("euroc.launch", loop_closure="false")[0])
        self.assertEqual(load("euroc.launch", load_map="false")[1][
            "/pose_graph/set/load_previous_pose_graph"], "0")

    def test_loop_closure_shows_the_map(self):
        nodes, _ = load("euroc.launch", rviz="true", loop_closure="true")
        self.assertEqual(rviz_layout(nodes), "map.rviz")

    def test_loop_closure_takes_the_images_as_the_trackers_do(self):
        parameters = load("euroc.launch", loop_closure="true", image_transport="compressed")[1]
        self.assertEqual(parameters["/pose_graph/image_transport"], "compressed")


class Programs(unittest.TestCase):
    def test_rosrun_finds_scripts_and_installed_programs(self):
        is_source = (LAUNCH.parent / "CMakeLists.txt").exists()  # rosrun ignores build/ in it
        for name in ("evaluate.py",) if is_source else ("run_offline", "evaluate.py"):
            result = subprocess.run(["rosrun", "plm_vins", name, "--help"],
                                    env=dict(os.environ, ROS_PACKAGE_PATH=PACKAGE_PATH),
                                    stdin=subprocess.DEVNULL,
                                    stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                    encoding="utf-8", check=False)
            self.assertEqual(result.returncode, 0, result.stdout)
            self.assertIn("--", result.stdout)


class RealSense(unittest.TestCase):
    def test_camera(self):
        parameters = load("realsense_d435i.launch")[1]
        self.assertEqual(parameters["/driver/unite_imu_method"], "linear_interpolation")
        self.assertEqual(parameters["/camera/stereo_module/emitter_enabled"], 0)
        config = pathlib.Path(parameters["/vins_estimator/config_file"]).read_text(encoding="utf-8")
        for side in ("width", "height"):
            self.assertIn(f"image_{side}: {parameters['/driver/infra_' + side]} ", config)

    def test_what_the_driver_publishes(self):
        for name, values in (("realsense_d435i", (False, False)),
                             ("realsense_d435i_stereo", (True, False)),
                             ("realsense_d435i_depth", (False, True))):
            parameters = load(name + ".launch")[1]
            self.assertEqual((parameters["/driver/enable_infra2"],
                              parameters["/driver/enable_depth"]), values)

    def test_bag_instead_of_the_camera(self):
        self.assertNotIn("/driver/enable_gyro", load("realsense_d435i.launch", bag="/a.bag")[1])

    def test_a_missing_driver_is_named(self):
        if "realsense2_camera" in rospkg.RosPack(PACKAGE_PATH.split(":")).list():
            self.skipTest("the driver is installed")
        result = subprocess.run(["roslaunch", "--nodes", LAUNCH / "realsense_d435i.launch"],
                                env=dict(os.environ, ROS_PACKAGE_PATH=PACKAGE_PATH),
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8",
                                check=False)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("realsense2_camera", result.stdout)


class Px4(unittest.TestCase):
    def test_relay(self):
        nodes, parameters = load("px4.launch", config="c.yaml", pose_rate="50",
                                 imu_to_base="-0.1 0 0 0 0 3.14")
        self.assertEqual((parameters["/mavros_relay/rate"], parameters["/mavros_relay/base_frame"]),
                         (50, "base_link"))
        self.assertEqual(nodes["imu_to_base"].args, "-0.1 0 0 0 0 3.14 body base_link")
        self.assertTrue(all(nodes[name].respawn for name in ("vins_estimator", "mavros_relay")))
        self.assertNotIn("/mavros/fcu_url", parameters)

    def test_a_bag_is_played_at_a_speed_of_its_own(self):
        for arguments, speed in (({}, "1"), ({"rate": "0.5"}, "0.5")):
            words = player_words("px4.launch", bag="/a.bag", pose_rate="50", **arguments)
            self.assertEqual(words[words.index("--rate") + 1], speed)

    def test_base_that_tf_has(self):
        self.assertNotIn("imu_to_base", load("px4.launch", config="c.yaml", imu_to_base="tf")[0])

    def test_mavros(self):
        parameters = load("px4.launch", config="c.yaml", fcu_url="/dev/ttyACM0:921600")[1]
        self.assertEqual(parameters["/mavros/fcu_url"], "/dev/ttyACM0:921600")


if __name__ == "__main__":
    unittest.main()
