for (const figure of document.querySelectorAll('figure')) {
  const svg = figure.querySelector('svg'), view = svg.viewBox.baseVal, all = svg.getAttribute('viewBox');
  const panels = svg.dataset.axes.split(';').map(panel => panel.split(',').map(Number));
  const [tools, whole, place] = ['p', 'button', 'span'].map(name => document.createElement(name));
  const at = event => new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
  const shown = (from, to, part) => Number((from + (to - from) * part).toPrecision(4));
  whole.textContent = 'whole';
  whole.hidden = true;
  place.textContent = 'Click or tap to zoom in.';
  svg.onpointermove = event => {
    const { x, y } = at(event);
    const panel = panels.find(([left, top, right, bottom]) => left <= x && x <= right && top <= y && y <= bottom);
    if (!panel) return;
    const [left, top, right, bottom, x0, x1, y0, y1] = panel;
    const up = y0 === y1 ? '' : ', up: ' + shown(y0, y1, (bottom - y) / (bottom - top));
    place.textContent = 'across: ' + shown(x0, x1, (x - left) / (right - left)) + up;
  };
  svg.onclick = event => {
    const { x, y } = at(event);
    svg.setAttribute('viewBox', [(view.x + x) / 2, (view.y + y) / 2, view.width / 2, view.height / 2].join(' '));
    whole.hidden = false;
  };
  whole.onclick = () => { svg.setAttribute('viewBox', all); whole.hidden = true; };
  tools.append(whole, place);
  figure.append(tools);
}
