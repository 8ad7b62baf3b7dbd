"""Draws trust.svg from the tables of ../trust.md: the share of trusted answers that miss alpha, a dot a kind, worst at the top of each group.

Needs Python alone. Bars are 95 % intervals of a share (Wilson 1927).
"""
from html import escape
from math import sqrt
from pathlib import Path

HERE = Path(__file__).parent
GROUPS = ["Inside the plain model", "Terms of the model family", "Structures that are not in the family"]
ROW, LEFT, WIDTH, RIGHT, TOP, MOST = 14, 330, 450, 20, 40, 45.0


def rows(page, group):
    """Name, trusted answers and share that misses, of each kind of a group."""
    section = page.split(f"## {group}\n")[1].split("\n## ")[0]
    for line in section.splitlines():
        cells = [cell.strip() for cell in line.split("|")[1:-1]]
        if len(cells) > 4 and cells[1].isdigit() and cells[0] not in GROUPS:
            name, cases, missed, doubtful, refused = cells[0], int(cells[1]), float(cells[3]), float(cells[5]), float(cells[6])
            yield name, cases * (1 - (doubtful + refused) / 100), missed / 100


def interval(share, count, z=1.96):
    centre, half = share + z * z / (2 * count), z * sqrt(share * (1 - share) / count + z * z / (4 * count * count))
    return (centre - half) / (1 + z * z / count), (centre + half) / (1 + z * z / count)


def main():
    page = (HERE.parent / "trust.md").read_text()
    x = lambda percent: LEFT + WIDTH * min(percent, MOST) / MOST
    parts, y = [], TOP
    for group in GROUPS:
        parts.append(f'<text x="8" y="{y + 10}" font-weight="bold">{escape(group)}</text>')
        y += ROW + 4
        for name, count, share in sorted(rows(page, group), key=lambda row: -row[2]):
            low, high = interval(share, count)
            parts.append(f'<text x="{LEFT - 8}" y="{y + 10}" text-anchor="end">{escape(name)}</text>')
            parts.append(f'<path d="M{x(100 * low):.1f} {y + 6}H{x(100 * high):.1f}" stroke="#7a8794" stroke-width="2"/>')
            parts.append(f'<circle cx="{x(100 * share):.1f}" cy="{y + 6}" r="3.2" fill="#0b5cad"/>')
            y += ROW
        y += 8
    ticks = "".join(
        f'<path d="M{x(tick)} {TOP - 8}V{y}" stroke="#d5dbe1"/><text x="{x(tick)}" y="{TOP - 14}" text-anchor="middle">{tick}</text>'
        for tick in range(0, int(MOST) + 1, 5)
    )
    aim = f'<path d="M{x(5)} {TOP - 8}V{y}" stroke="#c2410c" stroke-dasharray="4 3"/>'
    svg = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {LEFT + WIDTH + RIGHT} {y + 8}" font-family="sans-serif" font-size="11" fill="#16202b">'
        f'<rect width="100%" height="100%" fill="#fff"/><text x="8" y="14">Trusted answers that miss alpha, percent; dashed: 5 % of a 95 % interval</text>'
        f"{ticks}{aim}{''.join(parts)}</svg>\n"
    )
    (HERE / "trust.svg").write_text(svg)


if __name__ == "__main__":
    main()
