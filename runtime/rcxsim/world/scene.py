"""What a world file describes: the floor, the robot, and what people do; and where on the floor something is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import atan2, cos, hypot, pi

from golc.runtime.rcxsim.world.floor import Floor, nearest_on_lines
from golc.runtime.rcxsim.world.geometry import Point, Pose, nearest
from golc.runtime.rcxsim.world.people import Cue, Names, PutAt
from golc.runtime.rcxsim.world.robot import LightSensor, Robot


@dataclass(frozen=True)
class Scene:
    """A world before anything happens in it."""

    floor: Floor
    robot: Robot
    script: tuple[Cue, ...] = ()
    names: Names = field(default_factory=Names)

    def back_on_line(self, pose: Pose) -> Pose:
        """The pose on the nearest line that is most like this one; this one itself where there is no line."""
        found = nearest_on_lines(self.floor, pose.x, pose.y)
        if found is None:
            return pose
        ax, ay, bx, by = found[1]
        heading = atan2(by - ay, bx - ax)
        if cos(heading - pose.heading) < 0:
            heading += pi
        return Pose(*nearest(pose.x, pose.y, found[1]), heading)

    def eyes(self, pose: Pose) -> list[Point]:
        """The places under the robot's light sensors."""
        sensors = self.robot.sensors.values()
        return [pose.place(sensor.ahead, sensor.left) for sensor in sensors if isinstance(sensor, LightSensor)]

    def station_seen(self, pose: Pose) -> str | None:
        """The station whose mark the robot sees; without light sensors, the one that is between its wheels."""
        return self._station_under(self.eyes(pose) or [(pose.x, pose.y)])

    def station_at(self, pose: Pose) -> str | None:
        """The station at which a robot is: it sees the mark, or has it between its wheels."""
        return self._station_under([*self.eyes(pose), (pose.x, pose.y)])

    def _station_under(self, points: Sequence[Point]) -> str | None:
        for station in self.floor.stations.values():
            if any(station.mark.contains(*point) for point in points):
                return station.name
        return None

    def whereabouts(self, pose: Pose) -> str:
        """Where a robot is, for people: ``at station 3``, ``80 mm from station 3``, ``at (410, 220)``."""
        if (station := self.station_at(pose)) is not None:
            return f"at station {station}"
        away = [
            (hypot(pose.x - mark.pose.x, pose.y - mark.pose.y), name)
            for name, mark in ((station.name, station.mark) for station in self.floor.stations.values())
        ]
        place = f"at ({pose.x:.0f}, {pose.y:.0f})"
        return f"{place}, {min(away)[0]:.0f} mm from station {min(away)[1]}" if away else place


def pose_at_station(floor: Floor, put: PutAt) -> Pose:
    """The pose of a robot that is put at a station."""
    mark = floor.stations[put.station].mark.pose
    if put.facing is not None:
        return mark._replace(heading=put.facing)
    return mark._replace(heading=mark.heading + pi) if put.backward else mark
