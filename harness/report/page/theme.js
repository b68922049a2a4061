// The theme that the address asks for (?theme=dark or #theme=dark), else the one chosen here before, else the system's.
(function () {
  var asked = /theme=(dark|light)/.exec(location.search + location.hash), kept = null;
  try { kept = localStorage.getItem('plumb-theme'); } catch (refused) { kept = null; }
  var theme = asked ? asked[1] : kept;
  if (theme) document.documentElement.dataset.theme = theme;
})();
