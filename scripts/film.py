"""Draws the frames of `snug animate` and joins them into a GIF or MP4; started by it under a virtual display.

usage: film.py FOLDER OUT.gif|OUT.mp4…      FOLDER holds skin.pvd, garment.pvd
"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import picture

FRAMES_PER_SECOND = 15
REST = 20  # the last frame stands for so many
VIEWS = picture.VIEWS[:2]
WIDTH = 900


def main(folder, outs):
    if not shutil.which("ffmpeg"):
        sys.exit("ffmpeg is not installed")
    skins, garments = (picture.steps(folder / name) for name in ("skin.pvd", "garment.pvd"))
    count = max(len(skins), len(garments))
    # One scale for all frames: that of the last, where the garment is tight.
    last_skin = picture.read(skins[-1]) if skins else None
    last_sheet = picture.read(garments[-1]) if garments else None
    rows_of = []
    if last_skin:
        unit = "Pa" if picture.largest_inside(last_skin) < 2000 else "kPa"
        top = picture.round_up(max(picture.largest_inside(last_skin) / picture.PASCAL_PER_UNIT[unit], 1e-3))
        function = picture.colours(picture.VIRIDIS, top)

        def pressure(skin, sheet, edge):
            picture.scale(skin, "contact_pressure", picture.PASCAL_PER_UNIT[unit])
            return picture.pressure_row(skin, edge, function, unit, float("inf"))

        rows_of.append(pressure)
    if last_sheet:
        largest, name = picture.carrying(last_sheet)
        tension_function = picture.colours(picture.VIRIDIS, picture.round_up(max(largest, 1e-3)))
        rows_of.append(lambda skin, sheet, edge: picture.tension_row(sheet, skin, edge, tension_function, name))

    bounds = bounds_of(skins, garments)
    with tempfile.TemporaryDirectory(prefix="snug-film-") as work:
        for n in range(count):
            skin = picture.surface(picture.deformed(picture.read(skins[n]))) if skins else None
            sheet = picture.surface(picture.read(garments[n])) if garments else None
            edge = picture.plain(picture.outline(sheet), picture.INK, 2.0, 80000) if sheet else None
            window = picture.render([row(skin, sheet, edge) for row in rows_of], bounds, WIDTH, VIEWS)
            picture.save(window, Path(work) / f"{n:04}.png")
            window.Finalize()
        for out in outs:
            join(work, out)


def bounds_of(skins, garments):
    """A box that holds every frame; the garment is largest where it is placed."""
    boxes = [picture.read(files[n]).GetBounds() for files in (skins, garments) if files for n in (0, -1)]
    low = [min(box[2 * c] for box in boxes) for c in range(3)]
    high = [max(box[2 * c + 1] for box in boxes) for c in range(3)]
    return [value for pair in zip(low, high) for value in pair]


def join(work, out):
    hold = f"tpad=stop_mode=clone:stop={REST}"
    if out.suffix == ".gif":
        chain = f"{hold},split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=none"
        how = ["-filter_complex", chain, "-loop", "0"]
    else:
        how = ["-vf", hold, "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", "-movflags", "+faststart"]
    part = out.with_name("part-" + out.name)
    line = ["ffmpeg", "-v", "error", "-y", "-framerate", str(FRAMES_PER_SECOND), "-i", f"{work}/%04d.png", *how, str(part)]
    done = subprocess.run(line, capture_output=True, text=True)
    if done.returncode:
        part.unlink(missing_ok=True)
        sys.exit(f"ffmpeg: {done.stderr.strip()}")
    part.rename(out)


main(Path(sys.argv[1]), [Path(out) for out in sys.argv[2:]])
