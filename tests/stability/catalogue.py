"""All scenes of the catalogue, in the order of the page."""
import limbs
import meshes
import tubes


def all_scenes():
    scenes = [*tubes.scenes(), *limbs.all_scenes(), *meshes.all_scenes()]
    names = [scene.name for scene in scenes]
    twice = {name for name in names if names.count(name) > 1}
    unknown = {s.name: [b for b in (s.base, s.same_as) if b and b not in names] for s in scenes}
    assert not twice, twice
    assert not any(unknown.values()), {k: v for k, v in unknown.items() if v}
    return scenes
