// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Typesets formulas, and makes each picture a link to itself in full size.
for (const formula of document.querySelectorAll('.math')) {
  katex.render(formula.textContent, formula,
    {displayMode: formula.tagName === 'DIV', throwOnError: true});
}
for (const picture of document.querySelectorAll('article img')) {
  if (!picture.closest('a')) {
    const link = document.createElement('a');
    link.href = picture.src;
    link.className = 'picture';
    picture.replaceWith(link);
    link.append(picture);
  }
}
