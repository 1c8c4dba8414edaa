// Texts that overlap, are cut off, or stick out of the page.
() => {
  const faults = [];
  const page = document.documentElement;
  if (page.scrollWidth > innerWidth + 1) {
    const wide = [...document.querySelectorAll('body *')].filter(
      e => e.getBoundingClientRect().right > innerWidth + 1 && !e.closest('.wide, pre, .unseen'));
    const names = wide.slice(0, 3).map(e => e.tagName + '.' + e.className + '#' + e.id);
    faults.push('the page scrolls sideways: ' + names);
  }
  const boxes = [];
  const walker = document.createTreeWalker(document.getElementById('workbench'), NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const node = walker.currentNode, parent = node.parentElement;
    if (!node.data.trim() || parent.closest('option, .unseen, script, style, textarea')) continue;
    const style = getComputedStyle(parent);
    if (style.visibility === 'hidden' || style.display === 'none' || +style.opacity === 0) continue;
    if (!parent.checkVisibility()) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    for (const r of range.getClientRects()) {
      if (r.width < 1 || r.height < 1) continue;
      let box = {left: r.left, right: r.right, top: r.top, bottom: r.bottom};
      let cut = false;
      for (let e = parent; e && e !== document.body; e = e.parentElement) {
        const s = getComputedStyle(e), c = e.getBoundingClientRect();
        if (s.overflowX === 'visible' && s.overflowY === 'visible') continue;
        if (e.tagName.toLowerCase() === 'svg' && s.overflow === 'visible') continue;
        const scrolls = ['auto', 'scroll'].includes(s.overflowX) || ['auto', 'scroll'].includes(s.overflowY);
        if (!scrolls && (box.left < c.left - 2 || box.right > c.right + 2 || box.top < c.top - 3 || box.bottom > c.bottom + 3)) cut = true;
        box = {left: Math.max(box.left, c.left), right: Math.min(box.right, c.right),
               top: Math.max(box.top, c.top), bottom: Math.min(box.bottom, c.bottom)};
      }
      if (cut) faults.push('cut off: ' + node.data.trim().slice(0, 60));
      if (box.right - box.left < 2 || box.bottom - box.top < 2) continue;
      boxes.push({...box, node, text: node.data.trim().slice(0, 40)});
    }
  }
  for (let i = 0; i < boxes.length; i++) for (let k = i + 1; k < boxes.length; k++) {
    const a = boxes[i], b = boxes[k];
    if (a.node === b.node) continue;
    const w = Math.min(a.right, b.right) - Math.max(a.left, b.left);
    const h = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
    if (w > 2 && h > 4) faults.push('overlap: ' + a.text + ' | ' + b.text);
  }
  for (const s of document.querySelectorAll('select')) {
    if (!s.checkVisibility() || !s.selectedOptions.length) continue;
    const canvas = document.createElement('canvas').getContext('2d');
    const style = getComputedStyle(s);
    canvas.font = style.font;
    const room = s.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight) - 18;
    if (canvas.measureText(s.selectedOptions[0].text).width > room) faults.push('cut off in a list: ' + s.selectedOptions[0].text);
  }
  return faults;
}
