"""A log-log plot as SVG text, without a plotting library."""
import math

COLORS = ("#1b6ca8", "#c0392b", "#1e8449", "#b7950b", "#6c3483", "#555555")
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 640, 440, 70, 100, 36, 52


def ticks(low, high):
    """1, 2 and 5 times powers of ten from low to high."""
    return [m * 10 ** e for e in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1) for m in (1, 2, 5)
            if low <= m * 10 ** e <= high]


def bounds(values):
    return min(values) / 1.15, max(values) * 1.15


def log_plot(series, title, x_label, y_label):
    """`series`: name -> [(x, y)], all positive."""
    x_low, x_high = bounds([x for points in series.values() for x, _ in points])
    y_low, y_high = bounds([y for points in series.values() for _, y in points])

    def place(x, y):
        u = math.log(x / x_low) / math.log(x_high / x_low)
        v = math.log(y / y_low) / math.log(y_high / y_low)
        return LEFT + u * (WIDTH - LEFT - RIGHT), HEIGHT - BOTTOM - v * (HEIGHT - TOP - BOTTOM)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>', f'<text x="{LEFT}" y="22" font-size="15">{title}</text>']
    for x in ticks(x_low, x_high):
        px = place(x, y_low)[0]
        out.append(f'<path d="M{px:.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#ddd"/>'
                   f'<text x="{px:.1f}" y="{HEIGHT - BOTTOM + 18}" text-anchor="middle">{x:g}</text>')
    for y in ticks(y_low, y_high):
        py = place(x_low, y)[1]
        out.append(f'<path d="M{LEFT} {py:.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>'
                   f'<text x="{LEFT - 8}" y="{py + 4:.1f}" text-anchor="end">{y:g}</text>')
    out.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 12}" text-anchor="middle">{x_label}</text>')
    out.append(f'<text transform="translate(18 {(TOP + HEIGHT - BOTTOM) / 2}) rotate(-90)" text-anchor="middle">{y_label}</text>')
    for i, (name, points) in enumerate(series.items()):
        color = COLORS[i % len(COLORS)]
        places = [place(x, y) for x, y in sorted(points)]
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
        out.append(f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="2"/>')
        out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{color}"/>' for x, y in places]
        py = TOP + 16 + 20 * i
        out.append(f'<path d="M{WIDTH - RIGHT + 12} {py}h22" stroke="{color}" stroke-width="2"/>'
                   f'<text x="{WIDTH - RIGHT + 40}" y="{py + 4}">{name}</text>')
    return "\n".join(out + ["</svg>", ""])
